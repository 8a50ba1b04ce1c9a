#include <fmt/core.h>

#include <cmath>

#include "pipelines/accuracy_rungs.h"
#include "pipelines/fineness.h"
#include "pipelines/systematic_meshes.h"

namespace pipelines {
namespace {

/// Of the finest up to three meshes.
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

}  // namespace

SystematicRungs systematic_meshes(AccuracyBench& bench) {
  SystematicRungs rungs;
  auto& study = rungs.study;
  if (!can_be_refined(bench.body())) {
    study.convergence.refusal = "a finished .msh is taken as it is: there is no series of meshes";
    return rungs;
  }
  int before_level = 0;
  for (const int level : systematic_levels) {
    if (study.meshes.size() == 3 && study.convergence.usable()) break;
    const double predicted = before_level > 0
                                 ? rungs.rows.back().seconds * std::pow(double(level) / before_level,
                                                                        3 * AccuracyBench::growth_of_seconds)
                                 : 0;
    if (predicted > bench.seconds_left()) break;
    auto solid = bench.run_solid("systematic mesh", fmt::format("systematic mesh {}", level),
                                 systematic_mesh(bench.body(), level));
    if (!solid) continue;
    before_level = level;
    const auto& row = solid->row;
    if (study.meshes.size() == 3) study.meshes.erase(study.meshes.begin());
    study.meshes.push_back(
        {row.fineness, row.n_dofs, cell_size_m(solid->run.analyses.front().responses.nodes), row.value_Pa});
    rungs.rows.push_back(row);
    study.convergence = converge(study.meshes, bench.body().degree);
  }
  if (study.meshes.empty()) study.convergence = converge(study.meshes, bench.body().degree);
  if (study.convergence.usable())
    rungs.rows.back().errors.set_numerical({"discretisation",
                                            fmt::format("grid convergence index of {} meshes, factor {:g}",
                                                        study.convergence.n_meshes, study.convergence.safety),
                                            study.convergence.index_21});
  return rungs;
}

}  // namespace pipelines
