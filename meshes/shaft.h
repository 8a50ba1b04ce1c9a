/// Stepped shaft, solid or bored, with shoulder fillets and eccentric seats, meshed with structured
/// hexahedra; so are drums: shafts with a wide bore in the middle.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meshes/body_mesh.h"

namespace meshes {

/// One cylindrical length of the shaft.
struct ShaftSegment {
  std::string name;    ///< unique; also the port's name if it is one
  double begin_m = 0;  ///< z; end_m > begin_m
  double end_m = 0;
  double diameter_m = 0;
  double eccentricity_m = 0;  ///< offset of this segment's axis
  bool is_port = false;       ///< its surface takes load; see Shaft
  double eccentricity_angle_rad =
      0;                    ///< direction of the offset, counter-clockwise from +x (the body's xi axis)
  double bore_m = 0;        ///< diameter of the hole along z, concentric with the z axis; 0: solid
  std::string bore_port{};  ///< name of the port that the whole inside of the bore is; empty: none
};

/// Segments from left to right without gaps. fillets_m[i] is the radius at the shoulder between segments i
/// and i+1: at its inner corner, on the surface of the smaller diameter; 0: sharp corner. The loaded zone of
/// a port is centred in its segment: the segment less, at both ends, the larger of the fillets that lie on
/// its own surface. An eccentric segment is thicker than both neighbours, and these are concentric.
struct Shaft {
  std::vector<ShaftSegment> segments;
  std::vector<double> fillets_m;
};

struct ShaftMeshControl {
  int cells_per_fillet_quarter = 8;  ///< even, >= 2
  int n_sectors = 16;                ///< around, a multiple of 4, >= 8
  double growth = 1.0;  ///< slope of the axial cell size away from fillets; cells grow by at most e^growth
  double largest_cell_m = 0;         ///< axial; 0: chosen from the diameters
  double min_scaled_jacobian = 0.3;  ///< refused below
};

/// Meshes the shaft and writes `file` (through a temporary name).
/// Ports: every segment with is_port, and the end faces "end_1" (smallest z) and "end_2".
/// One call at a time in a process: gmsh is global.
/// @throws std::invalid_argument with the offending numbers: gaps, sizes that are not positive, repeated
/// names,
///         a fillet that does not fit its step (eccentric: r < (D - d)/2 - ecc) or its segment's length,
///         a port without room, an eccentricity that leaves the neighbour outside or the shifted ring flat,
///         bad controls
/// @throws std::runtime_error if the worst cell is below control.min_scaled_jacobian (place and value named),
///         or the file cannot be written
BodyMesh build_shaft(const Shaft& shaft, const ShaftMeshControl& control, const std::filesystem::path& file);

}  // namespace meshes
