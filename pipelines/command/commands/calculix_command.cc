#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <ostream>
#include <vector>

#include "fem/equations/loads/nodal_loads.h"
#include "fem/models/solid/model.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/command/calculix/calculix_model.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/write/files/staged_results.h"

namespace pipelines {
namespace {

struct CalculixCommandOptions : SceneOptions {
  std::filesystem::path output;  ///< directory; empty: the default
};

void refuse_what_has_no_equal(const Scene& scene) {
  if (scene.bodies.empty())
    throw StageRefused(scene.file.string() +
                       ": has no body, and only bodies have a mesh to write; add one, as [shaft], to "
                       "the scene, or take `loads --calculix`");
  for (const auto& body : scene.bodies)
    if (reader_of(body).has_elastic_feet(body))
      throw StageRefused(body.origin +
                         ": elastic_feet = true: the model for CalculiX is that of a free body; set it "
                         "to false for this command");
}

void calculix(const CalculixCommandOptions& options, std::ostream& out) {
  Scene scene = read_scene(options.scene, options.settings);
  refuse_what_has_no_equal(scene);
  const auto variant = variant_of(options);
  const auto directory = own_directory(options.output, default_directory(options), variant);
  std::vector<std::string> names;
  for (const auto& body : scene.bodies) names.push_back(body.name + ".inp");
  StagedResults staged(directory, names_of(names), "-o", variant);
  StageClock clock(progress_on_stderr(options.verbosity()));
  const fem::Environment environment(all_cores);
  const auto meshed = clock.run("mesh", [&] { return mesh_bodies(scene); });
  scene = with_effects_chosen(scene, meshed, negligible_share(scene.accuracy.tolerance));
  const auto masses = agree_masses(scene, meshed);
  // Unit loads do not depend on the instants; one turn tells which there are.
  auto coarse = scene;
  if (!kind_of(scene.machine).has_samples()) coarse.sampling.turns = 1;
  const auto history = clock.run("loads", [&] { return load_stage(coarse, masses.machine); });
  std::vector<BodyLoads> loads;
  for (std::size_t i = 0; i < meshed.size(); ++i)
    loads.push_back(clock.run("distribute", [&] {
      return distribute_body(coarse, scene.bodies[i], history, loaded_body(scene.bodies[i], meshed[i]),
                             masses);
    }));
  require_equilibrium(coarse, meshed, masses, loads);
  for (std::size_t i = 0; i < meshed.size(); ++i) {
    const auto& body = scene.bodies[i];
    const auto nodal = fem::nodal_loads(meshed[i].body, loads[i].unit_loads);
    std::vector<std::string> channels;
    for (const auto& load : loads[i].unit_loads) channels.push_back(load.channel);
    const auto name = body.name + ".inp";
    clock.run("write", [&] {
      write_calculix_model(staged.folder() / name, scene.title + ", " + body.name, channels, body.material,
                           nodal);
    });
    out << fmt::format("{}: {} elements, {} steps, one per unit load: {}\n", body.name, nodal.nodes.n_cells(),
                       channels.size(), (directory / name).string());
  }
  staged.publish();
  out << fmt::format("run: cd {} && ccx -i {}\n", directory.string(), scene.bodies.front().name);
}

}  // namespace

void add_calculix_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<CalculixCommandOptions>();
  auto* command = add_scene_command(app, "calculix",
                                    "the bodies' meshes and unit loads as input files of CalculiX", *options);
  command->add_option("-o,--output", options->output,
                      "directory of the <body>.inp (default: results/<scene>)");
  add_force_option(*command, *options);
  command->callback(to_choose(chosen, options, calculix));
}

}  // namespace pipelines
