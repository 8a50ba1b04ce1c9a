/// A meshed body as a value: where the .msh lies, and the tables that give its groups a meaning.
/// Lengths in m; z along the shaft; boundary and volume ids are the tags of the physical groups in the .msh,
/// each used once over boundaries and volumes together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace meshes {

/// A named place where load enters: a cylindrical seat, or a flat end face.
struct Port {
  enum class Kind { seat, end_face };
  std::string name;
  Kind kind = Kind::seat;
  int boundary_id = 0;
  double begin_m = 0, end_m = 0;  ///< range in z of the loaded surface; equal for an end face
  double radius_m = 0;
  double axis_x_m = 0, axis_y_m = 0;  ///< the seat's own axis (eccentric seats lie off the z axis)
};

/// A named piece of surface (every boundary face belongs to exactly one).
struct Feature {
  enum class Kind { seat, surface, fillet, shoulder, end_face };
  /// "main_bearing_1" (loaded zone of the port), "main_bearing_1 rim 2" (unloaded rest of its cylinder),
  /// "body_1", "fillet main_bearing_1/body_1", "shoulder main_bearing_1/body_1", "end_1"
  std::string name;
  Kind kind = Kind::surface;
  int boundary_id = 0;
  double begin_m = 0, end_m = 0;  ///< range in z
};

/// All cells of the volume group "ring_<segment>": cylinder coordinates (r, angle, z) about the z axis,
/// composed with the eccentric shift  (x, y) += s(r) (shift_x, shift_y),
///   s(r) = clamp((r - inner_radius)/(outer_radius - inner_radius), 0, 1).
/// No cell reaches across r = inner_radius. The group "core" has straight cells and no chart.
struct CylinderChart {
  int volume_id = 0;
  double shift_x_m = 0, shift_y_m = 0;
  double inner_radius_m = 0;  ///< r_a: inside it nothing is shifted; the radius of the core if concentric
  double outer_radius_m = 0;  ///< R: the surface of the segment, fully shifted
};

/// The faces of a fillet: part of a torus about the z axis.
/// Circle of `radius` about (z, r) = (centre_z, centre_radius).
struct TorusChart {
  int boundary_id = 0;
  double centre_z_m = 0, centre_radius_m = 0, radius_m = 0;
};

/// A plane z = const inside the body made of cell faces through the whole cross-section of one segment: not
/// at a shoulder, not inside the fan of a fillet, not an end face.
struct SectionPlane {
  double z_m = 0;
  double radius_m = 0;
  double axis_x_m = 0, axis_y_m = 0;
  std::string segment;
  bool plain = false;  ///< at least one half diameter away from both ends of its segment
};

struct MeshQuality {
  std::size_t n_cells = 0, n_vertices = 0;
  double min_scaled_jacobian = 0, median_scaled_jacobian = 0;
  double worst_x_m = 0, worst_y_m = 0, worst_z_m = 0;  ///< centre of the worst cell
};

struct BodyMesh {
  std::filesystem::path file;  ///< .msh, format 4.1, linear hexahedra, named physical groups
  std::vector<Port> ports;
  std::vector<Feature> features;
  std::vector<CylinderChart> cylinders;
  std::vector<TorusChart> tori;
  std::vector<SectionPlane> sections;  ///< ascending in z
  MeshQuality quality;
};

}  // namespace meshes
