#include "pipelines/judge/estimates/fineness.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "meshes/imported/load_apart.h"

namespace pipelines {
namespace {

/// Nearest multiple of `step`, at least `least`.
int whole(double wanted, int step, int least) {
  return std::max(least, step * int(std::lround(wanted / step)));
}

/// Steepest growth of the cells, of chambers as of shafts.
constexpr double steepest_growth = meshes::ShaftMeshControl::steepest_growth;

/// The mesher's own choice where the scene has none (meshes::ChamberMeshControl::size_m).
double usual_size_m(const meshes::Chamber& chamber) {
  return 0.15 * (chamber.tube.inner_radius_m + chamber.tube.wall_m);
}

/// "0.07 and " with the size of the finest weld toes, where some have their own.
std::string fine_toes_text(const meshes::ChamberMeshControl& mesh) {
  double walls = mesh.toe_walls;
  for (const auto& toe : mesh.fine_toes) walls = std::min(walls, toe.walls);
  return walls < mesh.toe_walls ? fmt::format("{:.2g} and ", walls) : "";
}

struct Refine {
  double factor;

  void operator()(ShaftShape& shape) const {
    auto& mesh = shape.mesh;
    mesh.cells_per_fillet_quarter = whole(factor * mesh.cells_per_fillet_quarter, 2, 2);
    for (int& cells : mesh.fillet_cells)
      if (cells > 0) cells = whole(factor * cells, 2, 2);
    mesh.n_sectors = whole(factor * mesh.n_sectors, 4, 8);
    mesh.growth = std::min(steepest_growth, mesh.growth / factor);
    mesh.largest_cell_m /= factor;
    (*this)(shape.solid);
  }
  void operator()(ChamberShape& shape) const {
    auto& mesh = shape.mesh;
    mesh.size_m = (mesh.size_m > 0 ? mesh.size_m : usual_size_m(shape.geometry)) / factor;
    mesh.cells_through_wall = std::clamp(int(std::lround(factor * mesh.cells_through_wall)), 1,
                                         meshes::ChamberMeshControl::most_cells_through_wall);
    mesh.growth = std::min(steepest_growth, mesh.growth / factor);
    mesh.toe_walls /= factor;
    for (auto& toe : mesh.fine_toes) toe.walls /= factor;
  }
  void operator()(meshes::Import& import) const { (*this)(import.control); }
  void operator()(meshes::SolidControl& control) const {
    control.size_factor /= factor;
    control.cells_per_circle = std::max(6, int(std::lround(factor * control.cells_per_circle)));
    control.smallest_size_m /= factor;
  }
};

}  // namespace

BodyScene with_fineness(const BodyScene& body, double factor) {
  BodyScene result = body;
  if (factor != 1) std::visit(Refine{factor}, result.shape);
  return result;
}

bool can_be_refined(const BodyScene& body) {
  const auto* import = std::get_if<meshes::Import>(&body.shape);
  return import == nullptr || meshes::format_of(import->geometry) != meshes::GeometryFormat::msh;
}

std::vector<std::string> fillets_of(const BodyScene& body) {
  std::vector<std::string> names;
  const auto* shaft = body.shaft();
  if (shaft == nullptr || !shaft->keyways.empty()) return names;
  const auto& [segments, fillets_m] = shaft->geometry;
  for (std::size_t i = 0; i + 1 < segments.size(); ++i)
    names.push_back(fillets_m[i] > 0 ? "fillet " + segments[i].name + "/" + segments[i + 1].name : "");
  return names;
}

namespace {

std::string locally_text(const BodyScene& body) {
  const auto n = body.refinements.size();
  return n == 0
             ? ""
             : fmt::format("; {} cells cut{}", body.refinements.back().cells.size(), n > 1 ? " at last" : "");
}

}  // namespace

std::string fineness_text(const BodyScene& body) {
  if (const auto* chamber = std::get_if<ChamberShape>(&body.shape))
    return fmt::format(
        "{} cells through the wall, {}{:.2g} walls at the weld toes, {:.3g} mm elsewhere{}",
        chamber->mesh.cells_through_wall, fine_toes_text(chamber->mesh), chamber->mesh.toe_walls,
        1e3 * (chamber->mesh.size_m > 0 ? chamber->mesh.size_m : usual_size_m(chamber->geometry)),
        locally_text(body));
  const auto* shaft = body.shaft();
  if (shaft == nullptr || !shaft->keyways.empty()) {
    const auto& control = shaft ? shaft->solid : std::get<meshes::Import>(body.shape).control;
    return fmt::format("{} cells around a circle, {} fine spots", control.cells_per_circle,
                       control.fine_spots.size());
  }
  const auto names = fillets_of(body);
  std::string cells;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!names[i].empty()) cells += fmt::format(" {}", shaft->mesh.cells_at(int(i)));
  const double rows = shaft->mesh.rows_factor;
  return fmt::format("cells on fillet quarters{}; {} sectors{}{}", cells, shaft->mesh.n_sectors,
                     rows > 1 ? fmt::format("; rows times {:.3g}", rows) : "", locally_text(body));
}

}  // namespace pipelines
