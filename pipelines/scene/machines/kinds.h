/// The machines that there are, each in a file of its own.
#pragma once

#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {

const MachineKind& vibratory_mill_kind();
const MachineKind& planetary_mill_kind();
const MachineKind& drive_train_kind();
const MachineKind& load_table_kind();

}  // namespace pipelines
