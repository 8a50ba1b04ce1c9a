#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "fem/stress/cells/surface_stress.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/study/accuracy/accuracy_models.h"
#include "pipelines/study/accuracy/systematic_meshes.h"

namespace pipelines {
namespace {

// Points on a face's edge: at 32 intervals what a parabola falls by between two of them is a thousandth of
// what it falls by between a face's nodes.
constexpr int intervals_on_face = 32;

/// The largest von Mises stress on the faces around the peak, at its instant: that at a node changes from
/// mesh to mesh with where the nodes happen to lie, which hides how stress converges.
double peak_between_nodes_Pa(const Judged& analysis) {
  const auto& peak = analysis.peak;
  const Eigen::ArrayXd factors = analysis.loads.history.values.col(peak.instant);
  double largest_Pa = peak.value_Pa;
  for (const auto& unit : fem::stress_on_faces_around_Pa(analysis.responses, peak.node, intervals_on_face,
                                                         analysis.places.excluded))
    largest_Pa = std::max(largest_Pa, von_mises_of(unit, factors));
  return largest_Pa;
}

/// Grid convergence index from the finest meshes, at most three.
GridConvergence converge(const std::vector<GridStudy::Mesh>& meshes, int degree) {
  std::vector<MeshValue> values;
  for (const auto& mesh : meshes) values.push_back({mesh.size_m, mesh.value_Pa});
  if (values.size() >= 2) return grid_convergence(values, degree);
  GridConvergence none;
  none.n_meshes = int(values.size());
  none.refusal =
      values.empty() ? "no mesh of the series could be run" : "one mesh alone tells nothing; give more time";
  return none;
}

void add(GridStudy& study, const SolidRun& solid) {
  const auto& analysis = solid.run.analyses.front();
  const bool is_hot_spot = !analysis.hot_spots.empty();  // extrapolated from fixed places
  const double value_Pa = is_hot_spot ? solid.row.value_Pa : peak_between_nodes_Pa(analysis);
  if (study.meshes.size() == 3) study.meshes.erase(study.meshes.begin());
  study.meshes.push_back(
      {solid.row.fineness, solid.row.n_dofs, cell_size_m(analysis.responses.nodes), value_Pa});
  study.between_nodes_Pa = value_Pa - solid.row.value_Pa;
  study.convergence = converge(study.meshes, analysis.scene.degree);
}

}  // namespace

SystematicModels systematic_meshes(AccuracyBench& bench) {
  SystematicModels models;
  auto& study = models.study;
  if (!can_be_refined(bench.body())) {
    study.convergence.refusal = "a finished .msh is taken as it is: there is no series of meshes";
    return models;
  }
  int before_level = 0;
  for (const int level : systematic_levels) {
    if (study.meshes.size() == 3 && study.convergence.usable()) break;
    const double predicted =
        before_level > 0
            ? models.rows.back().seconds * std::pow(double(level) / before_level, 3 * growth_of_seconds)
            : 0;
    const auto name = fmt::format("systematic mesh {}", level);
    if (predicted > bench.seconds_left()) {
      bench.leave_out_for_time(name, predicted, bench.seconds_left());
      break;
    }
    auto solid = bench.run_solid("systematic mesh", name, systematic_mesh(bench.body(), level));
    if (!solid) continue;
    before_level = level;
    add(study, *solid);
    models.rows.push_back(std::move(solid->row));
  }
  if (study.meshes.empty()) study.convergence = converge(study.meshes, bench.body().degree);
  if (study.convergence.usable())
    models.rows.back().errors.set_numerical(
        {"discretisation",
         fmt::format("grid convergence index of {} meshes, factor {:g}, and what lies between nodes",
                     study.convergence.n_meshes, study.convergence.safety),
         study.index_Pa()});
  return models;
}

}  // namespace pipelines
