#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <vector>

#include "fem/base/values/body_nodes.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/process_limits.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/pictures/port_picture.h"
#include "pipelines/write/pictures/port_surface.h"

namespace pipelines {
namespace {

struct PortsCommandOptions : SceneOptions {
  std::filesystem::path output;  ///< directory; empty: the default
};

void ports(const PortsCommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene, options.settings);
  if (scene.bodies.empty())
    throw StageRefused(scene.file.string() +
                       ": has no body, and only bodies have ports; add one, as [shaft], to the scene");
  const auto variant = variant_of(options);
  const auto directory = own_directory(options.output, default_directory(options), variant);
  std::vector<std::string> names;
  for (const auto& body : scene.bodies)
    for (const char* file : {"/ports.vtu", "/ports.png"}) names.push_back(body.name + file);
  StagedResults staged(directory, names_of(names), "-o", variant);
  StageClock clock(progress_on_stderr(options.verbosity()));

  // All meshes are made before any file: a body that cannot be meshed leaves nothing behind.
  std::vector<meshes::BodyMesh> meshed;
  std::vector<fem::Nodes> nodes;
  for (const auto& body : scene.bodies)
    clock.run("mesh", [&] {
      meshed.push_back(build_mesh(body));
      nodes.push_back(fem::body_nodes(to_fem_body(meshed.back(), body.material)));
    });
  for (std::size_t i = 0; i < meshed.size(); ++i) {
    const auto& name = scene.bodies[i].name;
    const auto place = directory / name, folder = staged.folder() / name;
    const auto vtu = folder / "ports.vtu";
    clock.run("write", [&] { write_port_surface(vtu, nodes[i], meshed[i]); });
    const bool drawn = clock.run("pictures", [&] {
      return write_port_picture(vtu, scene.title + ": ports of the " + name, folder / "ports.png",
                                cut_through_bores(meshed[i].ports));
    });
    if (!drawn) std::cerr << "no picture: " << why_nothing_draws() << "; ports.vtu opens in ParaView\n";
    out << fmt::format("{}: {} ports, {}{}\n", name, meshed[i].ports.size(), (place / "ports.vtu").string(),
                       drawn ? ", " + (place / "ports.png").string() : "");
  }
  staged.publish();
}

}  // namespace

void add_ports_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<PortsCommandOptions>();
  auto* command =
      add_scene_command(app, "ports", "pictures of the bodies with their ports coloured and named", *options);
  add_results_option(*command, options->output);
  add_force_option(*command, *options);
  command->callback(to_choose(chosen, options, ports));
}

}  // namespace pipelines
