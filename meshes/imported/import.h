/// A body of the user's own, as a file and its ports.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "meshes/checks/part_welds.h"
#include "meshes/solids/solid_control.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// All surfaces of a physical group of the .msh (STEP has none).
struct GroupSelection {
  std::string name;
};

/// All surfaces whose vertices lie in the box.
struct BoxSelection {
  std::array<double, 3> low_m{}, high_m{};
};

/// All surfaces on the cylinder parallel to z that is nearest in axis and radius (within 2 % of the radius)
/// and lies in the range of z.
struct CylinderSelection {
  enum class Side { outside, inside };  ///< the outside of a shaft, the inside of a hole
  double axis_x_m = 0, axis_y_m = 0, radius_m = 0;
  double begin_m = 0, end_m = 0;
  Side side = Side::outside;
};

struct ImportPort {
  std::string name;
  Port::Kind kind = Port::Kind::seat;  ///< seats and bores must be cylinders parallel to z
  std::variant<GroupSelection, BoxSelection, CylinderSelection> selection;
};

/// A sharp inner edge of a STEP part that is rounded for its effective notch stress.
struct PartNotch {
  Point at_m{};         ///< next to the edge: the nearest one is meant, and what goes on from it smoothly
  double radius_m = 0;  ///< reference radius
};

struct Import {
  std::filesystem::path geometry;  ///< .step, .stp, or .msh of any version
  double scale_to_m = 0;           ///< length of the file's unit; 0: 1e-3 for STEP (mm), 1 for .msh
  std::vector<ImportPort> ports;
  std::vector<PartWeld> welds{};     ///< hot-spot stress is read beside these sharp edges
  std::vector<PartNotch> notches{};  ///< of STEP files
  SolidControl control;              ///< for a .msh only min_scaled_jacobian and exclusion_m count
  double time_limit_s = 0;  ///< processor time for reading, and again for meshing; 0: from size and cells
};

}  // namespace meshes
