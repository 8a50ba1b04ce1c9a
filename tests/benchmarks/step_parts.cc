// How far the error that a run states bounds its true error on bodies from STEP files: five shafts whose
// largest stress is known. References: the axisymmetric model of the same drawing, whose largest shear or
// principal stress is printed beside that of the public tables (P08, P09).
//   step_parts_benchmark [--tolerance P] [cells around a circle...]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "fem/models/solid/model.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/search/cheap_models/cheap_responses.h"
#include "pipelines/search/loop/scene_run.h"
#include "tests/cases/program/step_shafts.h"

namespace {

namespace fs = std::filesystem;
using step_shafts::StepShaft;

pipelines::Scene read(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return pipelines::read_scene(file);
}

struct Reference {
  double von_mises_Pa = 0, change_Pa = 0;  ///< from cells twice as large
  double principal_Pa = 0;
};

Reference reference(const StepShaft& shaft, const fs::path& directory) {
  const auto scene = read(directory / "blocks.toml", step_shafts::scene_of_blocks(shaft));
  pipelines::StageClock clock;
  const auto& body = scene.bodies.at(0);
  const auto meshed = pipelines::mesh_body(body, {});
  const auto loads = pipelines::load_bodies(scene, {meshed}, clock).body_loads.at(0);
  Reference result;
  for (const double fineness : {1.0, 2.0}) {
    const auto model = pipelines::axisymmetric_responses(pipelines::with_fineness(body, fineness),
                                                         meshed.mesh, loads.unit_loads);
    const auto maximum = pipelines::envelope(loads.history, model->responses, 1);
    const auto places = pipelines::locate_nodes(model->responses.nodes, meshed.mesh.features,
                                                meshed.mesh.ports, meshed.mesh.sharp_edges);
    const auto largest = [&](const pipelines::NodalMaximum& of) {
      return of.value_Pa[pipelines::peak_node(of.value_Pa, places)];
    };
    result.change_Pa = largest(maximum.von_mises) - result.von_mises_Pa;
    result.von_mises_Pa = largest(maximum.von_mises);
    result.principal_Pa = largest(maximum.principal);
  }
  return result;
}

struct Outcome {
  double ratio = 0;  ///< stated over true error
  bool is_bounded = false;
};

Outcome row(const StepShaft& shaft, const Reference& truth, const std::string& mesh, double tolerance,
            const fs::path& directory) {
  const auto scene = read(directory / (shaft.name + ".toml"), step_shafts::scene_of_step(shaft, mesh));
  pipelines::SceneRunOptions options;
  options.fresh = true;
  options.cache = false;
  options.accuracy.tolerance = tolerance;
  pipelines::StageClock clock;
  const auto start = std::chrono::steady_clock::now();
  const auto run = pipelines::run_scene(scene, options, clock);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const auto& analysis = run.analyses.at(0);
  const double value_Pa = analysis.peak.value_Pa, off_Pa = std::abs(value_Pa - truth.von_mises_Pa),
               stated_Pa = analysis.peak.errors.numerical_Pa();
  fmt::print("{:10} {:24} {:8} {:9.2f} {:9.2f} {:8.2f} {:8.2f} {:7.1f} {:7.1f}\n", shaft.name, mesh,
             analysis.responses.n_dofs, value_Pa / 1e6, truth.von_mises_Pa / 1e6,
             100 * (value_Pa / truth.von_mises_Pa - 1), 100 * stated_Pa / value_Pa, stated_Pa / off_Pa,
             seconds.count());
  for (const auto& step : analysis.search.steps)
    fmt::print("{:>35} {:8} {:9.2f} {:18.2f} {:8.2f} {:7.1f} {:7.1f}  {}\n", "step", step.n_dofs,
               step.value_Pa / 1e6, 100 * (step.value_Pa / truth.von_mises_Pa - 1),
               100 * step.errors.numerical_Pa() / step.value_Pa,
               step.errors.numerical_Pa() / std::abs(step.value_Pa - truth.von_mises_Pa), step.seconds,
               step.fineness);
  std::fflush(stdout);
  return {stated_Pa / off_Pa, stated_Pa >= off_Pa};
}

}  // namespace

int main(int argc, char** argv) {
  const fem::Environment environment(0);
  const auto directory = fs::temp_directory_path() / "millstress_step_parts";
  fs::create_directories(directory);
  double tolerance = 0;
  std::vector<std::string> meshes;
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]) == "--tolerance" && i + 1 < argc)
      tolerance = std::stod(argv[++i]) / 100;
    else
      meshes.push_back(fmt::format("cells_per_circle = {}", argv[i]));
  if (meshes.empty()) meshes.push_back("");  // the program's own choice
  fmt::print("{:10} {:24} {:>8} {:>9} {:>9} {:>8} {:>8} {:>7} {:>7}\n", "shaft", "mesh", "unknowns", "MPa",
             "true MPa", "off, %", "stated %", "ratio", "s");
  std::vector<Outcome> outcomes;
  for (const auto& shaft : step_shafts::all()) {
    const auto truth = reference(shaft, directory);
    const double own_MPa =
        shaft.known_is_shear ? truth.von_mises_Pa / 1e6 / std::sqrt(3.0) : truth.principal_Pa / 1e6;
    if (shaft.known_MPa > 0)
      fmt::print("{:10} reference {:.3f} MPa where the table has {:.3f}\n", shaft.name, own_MPa,
                 shaft.known_MPa);
    step_shafts::write_step(shaft, directory / (shaft.name + ".step"));
    for (const auto& mesh : meshes) outcomes.push_back(row(shaft, truth, mesh, tolerance, directory));
  }
  const auto count = [&](const auto& is) { return std::count_if(outcomes.begin(), outcomes.end(), is); };
  fmt::print("{} of {} bounded, {} of them within a factor of five\n",
             count([](const Outcome& o) { return o.is_bounded; }), outcomes.size(),
             count([](const Outcome& o) { return o.is_bounded && o.ratio <= 5; }));
  fs::remove_all(directory);
}
