#include <CLI/CLI.hpp>

#include <memory>
#include <ostream>
#include <string>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/command/options/commands.h"
#include "pipelines/scene/materials/material_library.h"
#include "pipelines/scene/materials/material_report.h"

namespace pipelines {
namespace {

struct MaterialsOptions {
  std::string name;
  bool json = false;
};

std::vector<LibraryMaterial> materials_named(const std::string& name) {
  if (name.empty()) return material_library();
  if (const auto* material = find_material(name)) return {*material};
  const auto near = near_materials(name);
  throw OptionError("materials " + name + ": is not in the library" +
                    (near.empty() ? std::string("; millstress materials lists it")
                                  : "; the nearest of it: " + listed(near)));
}

void show_materials(const MaterialsOptions& options, std::ostream& out) {
  const auto materials = materials_named(options.name);
  out << (options.json ? materials_json(materials) : materials_text(materials));
}

}  // namespace

void add_materials_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<MaterialsOptions>();
  auto* command =
      app.add_subcommand("materials", "the library of materials: strengths by thickness, with their source");
  command->add_option("name", options->name, "one material alone");
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->callback(to_choose(chosen, options, show_materials));
}

}  // namespace pipelines
