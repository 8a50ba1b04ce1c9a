#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/command/commands/scene_templates.h"
#include "pipelines/command/options/commands.h"
#include "pipelines/command/options/output_files.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

struct InitOptions {
  std::string kind;
  fs::path output;  ///< file of the scene; empty: the default
};

std::vector<std::string> template_kinds() {
  std::vector<std::string> kinds;
  for (const auto& offered : scene_templates()) kinds.push_back(offered.kind);
  return kinds;
}

const SceneTemplate& template_of(const std::string& kind) {
  for (const auto& offered : scene_templates())
    if (offered.kind == kind) return offered;
  const auto kinds = template_kinds();
  const auto near = nearest_name(kind, kinds);
  throw OptionError("init " + kind + ": is no kind of scene" +
                    (near.empty() ? "" : "; did you mean \"" + near + "\"?") +
                    "; the kinds are: " + listed(kinds));
}

bool has_text(const fs::path& file, const std::string& text) {
  std::error_code none;
  if (fs::symlink_status(file, none).type() != fs::file_type::regular) return false;
  return whole_file(file, text.size()) == text;
}

void require_missing(const fs::path& file, const std::string& remedy) {
  std::error_code none;
  if (!fs::exists(fs::symlink_status(file, none))) return;
  throw OptionError(file.string() + ": is there already, and is not replaced; " + remedy);
}

/// A name as a shell takes it.
std::string quoted_name(const fs::path& file) {
  auto text = file.string();
  const bool is_plain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string("._-/+,").find(char(c)) != std::string::npos;
  });
  if (is_plain && text[0] != '-') return text;
  std::string quoted = text[0] == '-' ? "'./" : "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// A file that the scene reads and that is there already as it would be written stays: two scenes may share
/// it.
void init(const InitOptions& options, std::ostream& out) {
  const auto& chosen = template_of(options.kind);
  const fs::path scene = options.output.empty() ? fs::path(chosen.scene.name) : options.output;
  require_missing(scene, "give -o a new name, or move it away");
  std::vector<OutputFile> outputs{{"-o", scene}};
  std::vector<std::pair<fs::path, const TemplateFile*>> inputs;
  for (const auto& input : chosen.inputs) {
    const auto file = scene.parent_path() / input.name;
    outputs.push_back({"init " + chosen.kind, file});
    if (has_text(file, input.text)) continue;
    require_missing(file, "the scene needs a file of this name: move it away, or give -o another folder");
    inputs.emplace_back(file, &input);
  }
  for (const auto& output : outputs) require_replaceable(output.file, output.option);
  require_different(outputs);
  const auto replaces_nothing = [](const fs::path&) { return false; };
  for (const auto& [file, input] : inputs) write_text_file(file, input->text, replaces_nothing);
  write_text_file(scene, chosen.scene.text, replaces_nothing);
  out << scene.string() << ": a scene that runs; its comments say what to change\n";
  for (const auto& [file, input] : inputs) out << file.string() << ": is read by it\n";
  const auto name = quoted_name(scene);
  out << "next:\n  millstress check " << name << "\n  millstress run " << name << '\n';
}

}  // namespace

void add_init_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<InitOptions>();
  auto* command = app.add_subcommand("init", "a scene with comments that runs, to begin with");
  command->add_option("kind", options->kind, "one of " + listed(template_kinds()))->required();
  command->add_option("-o,--output", options->output, "file to write (default: KIND.toml)");
  command->callback(to_choose(chosen, options, init));
}

}  // namespace pipelines
