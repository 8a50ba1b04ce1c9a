/// Where a lug ends on its pad.
#pragma once

#include "meshes/chamber/chamber_layout.h"

namespace meshes {

/// @param direction_rad from the tube's axis to the foot
PadContact pad_contact(const Chamber& chamber, const ChamberFoot& foot, double direction_rad);

}  // namespace meshes
