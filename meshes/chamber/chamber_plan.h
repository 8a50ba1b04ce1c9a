/// The chamber's cross-section in blocks.
#pragma once

#include "meshes/chamber/chamber_stations.h"
#include "meshes/chamber/chamber_surfaces.h"
#include "meshes/spacing/swept_plan.h"

namespace meshes {

Plan build_plan(const Chamber& chamber, const ChamberLayout& layout, const ChamberStations& stations,
                const ChamberSurfaces& surfaces, const ChamberMeshControl& control);

}  // namespace meshes
