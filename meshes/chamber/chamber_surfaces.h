/// The groups of the chamber and what they mean, known before the mesh.
#pragma once

#include <map>
#include <vector>

#include "meshes/chamber/chamber_layout.h"
#include "meshes/checks/sharp_edges.h"
#include "meshes/values/cell_mesh.h"

namespace meshes {

/// Volume groups.
enum ChamberVolume : int {
  tube_volume = 1,
  flanges_volume,
  webs_volume,
  lugs_volume,
  pads_volume,
  housing_volume
};

/// Ids of the boundary groups, all different from the volumes'. "1" is the back of a pair, "2" the front.
struct ChamberSurfaces {
  int tube_outside = 0, inner_wall = 0, tube_end_1 = 0, tube_end_2 = 0;
  int flange_1 = 0, flange_2 = 0, covers = 0;
  int housing_outside = 0, housing_bore = 0, housing_end_1 = 0, housing_end_2 = 0;
  std::vector<int> webs;               ///< each in one group
  std::vector<int> lugs, pads, soles;  ///< per foot, front and back together
  std::vector<Feature> features;
  std::map<int, PlateSurface> plates;  ///< name, thickness and roundness of every group
};

ChamberSurfaces name_surfaces(const Chamber& chamber, const ChamberLayout& layout);

GroupNames group_names(const ChamberSurfaces& surfaces);
std::vector<Port> ports_of(const Chamber& chamber, const ChamberSurfaces& surfaces);
std::vector<CylinderChart> cylinders_of(const Chamber& chamber, const ChamberLayout& layout);
std::vector<Region> regions_of_chamber();

}  // namespace meshes
