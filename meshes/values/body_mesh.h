/// A meshed body as a value: its cells, and the tables that give their groups a meaning. Lengths in m; z
/// along the shaft; each id of a group is used once over boundaries and volumes together.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "meshes/values/cell_mesh.h"

namespace meshes {

/// A named place where load enters: the outside of a cylinder parallel to z (seat), the inside of one (bore,
/// wall of a chamber), or any other surface (face: end faces, pads), which may consist of several pieces.
struct Port {
  enum class Kind { seat, bore, face };
  std::string name;
  Kind kind = Kind::seat;
  int boundary_id = 0;
  /// Range in z of the loaded surface; equal for an end face, and for a face of an imported body, which has
  /// the centre of its area there.
  double begin_m = 0, end_m = 0;
  double radius_m = 0;  ///< radius of the cylinder, or of a round end face; 0 for other faces
  /// The cylinder's own axis; the point of a face about which it is loaded.
  double axis_x_m = 0, axis_y_m = 0;
};

/// A named piece of surface (every boundary face belongs to exactly one).
struct Feature {
  enum class Kind { seat, surface, fillet, shoulder, end_face, bore };
  /// "main_bearing_1" (loaded zone of the port), "main_bearing_1 rim 2" (unloaded rest of its cylinder),
  /// "body_1", "fillet main_bearing_1/body_1", "shoulder main_bearing_1/body_1", "end_1",
  /// "bore shell", "shoulder bore cover_1/shell" (the face of a step between bores)
  std::string name;
  Kind kind = Kind::surface;
  int boundary_id = 0;
  double begin_m = 0, end_m = 0;  ///< range in z
};

/// Map of all cells of a volume group: cylinder coordinates (r, angle, z) about the axis through (axis_x,
/// axis_y), composed with the eccentric shift (x, y) += s(r) (shift_x, shift_y),
///   s(r) = clamp((r - inner_radius)/(outer_radius - inner_radius), 0, 1).
/// No cell reaches across r = inner_radius. A group without a chart (the core of a shaft) has straight cells.
struct CylinderChart {
  int volume_id = 0;
  double shift_x_m = 0, shift_y_m = 0;
  /// r_a: inside it nothing is shifted; that of the core or of the bore if concentric.
  double inner_radius_m = 0;
  double outer_radius_m = 0;  ///< R: the surface of the segment, fully shifted
  double axis_x_m = 0, axis_y_m = 0;
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
  bool plain = false;         ///< at least one half diameter away from both ends of its segment
  double inner_radius_m = 0;  ///< radius of the bore, concentric with the z axis; 0: solid
};

/// Cells whose mass is counted together, where a body has several such parts (the chamber: "structure",
/// "exciter").
struct Region {
  std::string name;
  std::vector<int> volume_ids;
};

/// A re-entrant edge of the model that is sharp where the part is not: stress has no converged value there,
/// and none is reported within `distance`, which the geometry (never the mesh) fixes.
struct SharpEdge {
  std::string name;
  double distance_m = 0;
  std::vector<std::array<std::array<double, 3>, 2>> pieces;  ///< straight pieces, ends in m
  std::map<int, double> distance_on_m = {};  ///< by boundary id, on surfaces where it is larger
};

/// Where the structural hot-spot stress of a weld toe is read: vertices of the mesh on the plate's surface,
/// at 0.4 and 1.0 plate thicknesses from the toe or within 0.05 of that; the stress at the toe follows in a
/// straight line, 1.67 s(0.4 t) - 0.67 s(1.0 t).
struct HotSpot {
  std::string name;
  double thickness_m = 0;
  std::array<double, 3> toe_m{}, near_m{}, far_m{};
};

/// A surface that rounds a weld's edge by a reference radius, for the effective notch stress.
struct EffectiveNotch {
  int boundary_id = 0;
  double radius_m = 0;
  std::vector<std::array<double, 3>> course_m;  ///< points along the edge as it was
};

/// An edge of tetrahedra on a curved surface that is straighter than that surface, since cells as curved as
/// it would be inverted.
struct StraightEdge {
  std::array<double, 3> middle_m{};
  double length_m = 0;
  double off_m = 0;  ///< distance of its middle from where the surface has it
};

struct MeshQuality {
  std::size_t n_cells = 0, n_vertices = 0;
  double min_scaled_jacobian = 0, median_scaled_jacobian = 0;
  double worst_x_m = 0, worst_y_m = 0, worst_z_m = 0;  ///< centre of the worst cell
  double max_aspect = 0;                               ///< longest edge of a cell over its shortest
};

struct BodyMesh {
  std::shared_ptr<const CellMesh> cells;  ///< none: the body is only described
  GroupNames groups;                      ///< names of the volumes and boundaries of `cells`
  std::vector<Port> ports;
  std::vector<Feature> features;
  std::vector<CylinderChart> cylinders;
  std::vector<TorusChart> tori;
  std::vector<SectionPlane> sections;  ///< ascending in z; shafts only
  std::vector<Region> regions;         ///< empty: the whole body is one
  std::vector<SharpEdge> sharp_edges;
  std::vector<HotSpot> hot_spots;
  /// Names of hot spots that are not read: other plates are in the way.
  std::vector<std::string> covered_toes;
  std::vector<EffectiveNotch> notches;       ///< imported STEP files only
  std::vector<StraightEdge> straight_edges;  ///< imported STEP files and keyed shafts only
  double smallest_size_m = 0;                ///< no edge of an imported STEP file's mesh is wanted shorter
  MeshQuality quality;
};

}  // namespace meshes
