#include "meshes/solids/solid_control.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "meshes/solids/cell_estimate.h"
#include "meshes/solids/flat_cells.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

constexpr double growth = 0.5;  // slope of the cell size over the distance
/// Precision of a curve's length in cells, for which gmsh integrates the size. The size has kinks, at which
/// gmsh's own 1e-9 takes a hundred times longer.
constexpr double curve_precision = 1e-4;
const char* const extend_from_boundary = "Mesh.MeshSizeExtendFromBoundary";

double diagonal_of_model() {
  double low[3], high[3];
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

/// Elements of a curve in the mesh of curves: none at a point of an axis.
std::size_t n_elements(int curve) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 1, curve);
  return types.empty() ? 0 : tags[0].size();
}

/// Curves whose distance is one field: elements of a length within a tenth, and as many points along each.
struct CurvesOfSize {
  int step = 0;      ///< step of the element length: 1.1^step and more
  int n_points = 0;  ///< gmsh takes the distance from points: two for each element and more, at least 200
  bool operator<(const CurvesOfSize& other) const {
    return std::pair(step, n_points) < std::pair(other.step, other.n_points);
  }
};

/// @param most  largest size wanted
CurvesOfSize size_of(int curve, std::size_t n, double most) {
  constexpr int least_points = 200;
  const double length = measure_of(1, curve), its_size = std::min(length / double(n), most);
  CurvesOfSize size{int(std::floor(std::log(its_size) / std::log(1.1))), least_points};
  while (size.n_points * its_size < 2 * length) size.n_points *= 2;
  return size;
}

/// The ball's size inside, growing with the distance from it by `growth` up to the largest size.
int field_of(const FineSpot& spot, double unit_m, double largest) {
  const double inside = spot.size_m / unit_m, outside = std::max(inside, largest);
  const int field = gmsh::model::mesh::field::add("Ball");
  const auto set = [&](const char* name, double value) {
    gmsh::model::mesh::field::setNumber(field, name, value);
  };
  set("XCenter", spot.centre_m[0] / unit_m);
  set("YCenter", spot.centre_m[1] / unit_m);
  set("ZCenter", spot.centre_m[2] / unit_m);
  set("Radius", spot.radius_m / unit_m);
  set("VIn", inside);
  set("VOut", outside);
  set("Thickness", (outside - inside) / growth);
  return field;
}

/// Cells grow gently with the distance from every curve: without this a narrow surface beside a fillet gets
/// cells as long as its other edge asks for. Meshes the curves, and forgets them again.
void limit_growth(const SolidControl& control, double unit_m, double largest) {
  const auto along_narrow = sizes_along_narrow_surfaces(control.smallest_size_m / unit_m, largest);
  gmsh::model::mesh::generate(1);
  std::map<CurvesOfSize, std::vector<double>> curves_of_size;
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  for (const auto& curve : curves)
    if (const auto n = n_elements(curve.second); n > 0) {
      const auto narrow = along_narrow.find(curve.second);
      const double most = narrow == along_narrow.end() ? largest : narrow->second;
      curves_of_size[size_of(curve.second, n, most)].push_back(curve.second);
    }
  std::vector<double> fields;
  for (const auto& [its_size, its_curves] : curves_of_size) {
    const int distance = gmsh::model::mesh::field::add("Distance");
    gmsh::model::mesh::field::setNumbers(distance, "EdgesList", its_curves);
    gmsh::model::mesh::field::setNumber(distance, "NumPointsPerCurve", its_size.n_points);
    const int size = gmsh::model::mesh::field::add("MathEval");
    gmsh::model::mesh::field::setString(size, "F",
                                        std::to_string(std::pow(1.1, its_size.step + 0.5)) + "+" +
                                            std::to_string(growth) + "*F" + std::to_string(distance));
    fields.push_back(size);
  }
  for (const auto& spot : control.fine_spots) fields.push_back(field_of(spot, unit_m, largest));
  const int smallest = gmsh::model::mesh::field::add("Min");
  gmsh::model::mesh::field::setNumbers(smallest, "FieldsList", fields);
  gmsh::model::mesh::field::setAsBackgroundMesh(smallest);
  gmsh::model::mesh::clear();
}

}  // namespace

void check_control(const SolidControl& control) {
  const auto refuse = [](const std::string& what) { throw GeometryRefused("mesh control: " + what); };
  const auto check_length = [&](const char* name, double value) {
    if (!std::isfinite(value) || value < 0)
      refuse(std::string(name) + " = " + std::to_string(value) + " must be positive, or 0");
  };
  check_length("size_m", control.size_m);
  check_length("smallest_size_m", control.smallest_size_m);
  check_length("exclusion_m", control.exclusion_m);
  if (!std::isfinite(control.size_factor) || control.size_factor <= 0)
    refuse("size_factor = " + std::to_string(control.size_factor) + " must be positive");
  for (const auto& spot : control.fine_spots)
    if (!(spot.size_m > 0 && spot.radius_m >= 0)) refuse("a fine spot needs a positive size and a radius");
  if (control.cells_per_circle < 6)
    refuse("cells_per_circle = " + std::to_string(control.cells_per_circle) + " must be at least 6");
  if (!(control.min_scaled_jacobian > 0 && control.min_scaled_jacobian < 1))
    refuse("min_scaled_jacobian = " + std::to_string(control.min_scaled_jacobian) +
           " must lie between 0 and 1");
}

double longest_edge(const SolidControl& control, double unit_m) {
  return control.size_factor * (control.size_m > 0 ? control.size_m / unit_m : diagonal_of_model() / 20);
}

void mesh_solids(const SolidControl& control, double unit_m) {
  const auto set = [](const char* name, double value) { gmsh::option::setNumber(name, value); };
  const double size = longest_edge(control, unit_m);
  set("General.NumThreads", 1);
  set("Mesh.Algorithm", 6);
  set("Mesh.Algorithm3D", 1);
  set("Mesh.MeshSizeMax", size);
  set("Mesh.MeshSizeMin", smallest_edge(control, unit_m));
  set("Mesh.MeshSizeFromCurvature", control.cells_per_circle);
  set("Mesh.MeshSizeFromPoints", 0);
  set("Mesh.LcIntegrationPrecision", curve_precision);
  limit_growth(control, unit_m, size);
  // Between two small holes gmsh would interpolate the size of their edges, and mesh all of a perforated
  // plate as finely as these. Volumes begin with the size of their surface's cells.
  set(extend_from_boundary, 0);
  gmsh::model::mesh::generate(2);
  set(extend_from_boundary, 1);
  gmsh::model::mesh::generate(3);
  split_flat_cells();
  gmsh::model::mesh::setOrder(2);
}

}  // namespace meshes
