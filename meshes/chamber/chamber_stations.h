/// Where the chamber's cells begin and end around the tube and along z, and the hot spots they serve.
#pragma once

#include <vector>

#include "meshes/chamber/chamber_hot_spots.h"
#include "meshes/chamber/chamber_layout.h"

namespace meshes {

struct ChamberStations {
  std::vector<double> z_m;         ///< ascending
  std::vector<double> angles_rad;  ///< around the tube, ascending from 0 to below 2 pi
  ChamberHotSpots hot_spots;       ///< all their points are on stations and angles
};

/// The wanted cell size: `begin_m` and `end_m` at the ends of a line, growing to `largest_m`.
struct ToeSizes {
  double begin_m = 0, end_m = 0, largest_m = 0, growth = 0;
};

/// Cell boundaries from begin to end. At least n_min cells.
std::vector<double> between_toes(double begin_m, double end_m, const ToeSizes& sizes, int n_min);

/// @throws GeometryRefused if edges or faces come closer than layout.closest_m without meeting
ChamberStations place_stations(const Chamber& chamber, const ChamberLayout& layout,
                               const ChamberMeshControl& control);

}  // namespace meshes
