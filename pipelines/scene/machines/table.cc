/// The kinds of machines that there are: a new one is entered here and in Machine, at the same place.
#include <algorithm>

#include "pipelines/scene/machines/kinds.h"

namespace pipelines {

const std::vector<const MachineKind*>& machine_kinds() {
  static const std::vector<const MachineKind*> kinds{&vibratory_mill_kind(), &planetary_mill_kind(),
                                                     &drive_train_kind(), &load_table_kind()};
  return kinds;
}

const MachineKind& kind_of(const Machine& machine) {
  return *machine_kinds().at(machine.index());
}

const MachineKind* find_machine_kind(const std::string& type) {
  const auto& kinds = machine_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const auto* kind) { return kind->type() == type; });
  return found == kinds.end() ? nullptr : *found;
}

bool has_samples(const kinetics::LoadHistory& history) {
  const MachineKind* const kind = find_machine_kind(history.machine);
  return kind != nullptr && kind->has_samples();
}

}  // namespace pipelines
