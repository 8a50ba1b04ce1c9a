/// What a run will take before anything is solved, model by model, in seconds of the machine that the
/// constants were measured on (fem/base/values/cost_constants.h): within a factor of three on others.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "fem/base/values/solver_choice.h"
#include "pipelines/loads/stage/body_loads.h"
#include "pipelines/loads/stage/body_mesh.h"

namespace pipelines {

/// Solve and superposition of one model.
struct ModelForecast {
  std::string model;
  std::size_t n_dofs = 0;
  fem::Solver solver = fem::Solver::direct;  ///< automatic: the model has its own
  double solve_s = 0, superpose_s = 0;
  double gigabytes = 0;    ///< memory of solver and unit responses
  std::string left_out{};  ///< not empty: why its mesh was refused; nothing else is known of it
};

/// What the loads ask of every model.
struct ForecastLoads {
  std::size_t n_channels = 0, n_instants = 0;  ///< instants: n_superposed
  std::vector<kinetics::Spring> springs{};
  const BodyLoads* of_body = nullptr;  ///< tell where a search's first mesh is fine; null: nowhere
};

/// First the scene's own mesh; then beam and harmonics (round shafts), even meshes whose cells are 1/0.5 to
/// 1/3 of the scene's, and the mesh that a search for a tolerance begins with, which is built for it. Models
/// that the body does not have are left out; one whose mesh is refused says why. Of a body that is described
/// alone (described_body.h) all follow from its measures, and nothing is built.
std::vector<ModelForecast> forecast_ladder(const BodyScene& body, const MeshedBody& meshed,
                                           const ForecastLoads& loads);

/// What the table has not, in lines: natural frequencies, submodels of weld toes. Empty where neither is
/// asked for.
std::string forecast_beside(const BodyScene& body, const MeshedBody& meshed);

/// A table with one line for each model.
void print_models(std::ostream& out, const std::vector<ModelForecast>& models);

/// The forecast as lines of `check -v`.
void print_forecast(std::ostream& out, const BodyScene& body, const MeshedBody& meshed,
                    const std::vector<ModelForecast>& models);

/// A whole run, as the scene asks for it: meshes, searches and pictures too.
struct RunForecast {
  double seconds = 0, gigabytes = 0;
  bool ends_by_limit = false;  ///< the time limit, of the scene or the default, is shorter than the searches
};

/// Forecast from the models of each body, in the order of the scene. A search is taken as a few times its
/// first mesh, as the shipped scenes' searches are (README.md): within a factor of three.
RunForecast forecast_run(const Scene& scene, const std::vector<std::vector<ModelForecast>>& ladders);

/// The same before anything is distributed, for a progress bar: of as many unit loads as a shaft or a chamber
/// has. 0 where a mesh alone tells what a body is.
double expected_seconds(const Scene& scene);

}  // namespace pipelines
