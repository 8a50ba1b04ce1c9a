#include "tests/fuzz/kinds/samples.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "meshes/imported/apart.h"
#include "pipelines/base/files/json_file.h"
#include "pipelines/respond/responses/response_files.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/report/html_report.h"
#include "tests/fuzz/child.h"
#include "tests/fuzz/kinds/import_samples.h"
#include "tests/fuzz/verdicts.h"
#include "tests/unit/pipelines/examples/example_responses.h"

namespace fuzz {
namespace {

namespace fs = std::filesystem;

std::string source_file(const std::string& name) {
  auto text = read_bytes(fs::path(SOURCE_DIR) / name);
  if (text.empty()) throw std::runtime_error(name + " is missing or empty");
  return text;
}

/// The scenes of tests/refused are edited before they are read.
std::string base_scene(const std::string& name) {
  auto text = source_file("tests/refused/base/" + name);
  const std::string path = "@SOURCE@/pipelines/scenes/";
  for (auto at = text.find(path); at != std::string::npos; at = text.find(path)) text.erase(at, path.size());
  return text;
}

/// The same numbers as a logger writes them: other separators, over time.
std::string logged_table(char separator) {
  std::string text = "\"time [s]\"" + std::string(1, separator) + "pulley_seat.fx [kN]" + separator +
                     "pulley_seat.torque [N m]\r\n";
  for (int i = 0; i < 40; ++i)
    text += std::to_string(1.0 / 340 * i) + separator + std::to_string(0.2 + 0.001 * (i % 7)) + separator +
            std::to_string(-9.5e-1 * i) + "\r\n";
  return text;
}

/// Without the time of writing: a case is the same on any day.
std::string undated(std::string step) {
  const auto name = step.find("FILE_NAME(");
  const auto comma = step.find(',', name), after = step.find(',', comma + 1);
  if (after == std::string::npos) throw std::runtime_error("the STEP file has no name and date");
  return step.replace(comma + 1, after - comma - 1, "'2026-11-23T00:00:00'");
}

/// The results with seconds and gigabytes that are always the same.
void set_timing(const fs::path& results) {
  auto summary = pipelines::read_json_file(results / "summary.json");
  for (auto& cost : summary.at("timing")) cost = {{"seconds", 0.25}, {"peak_memory_gigabytes", 0.5}};
  write_bytes(results / "summary.json", summary.dump(2) + "\n");
  write_bytes(results / "report.html", pipelines::html_report(results, results / "accuracy"));
  const auto directory = pipelines::OpenDirectory::at(results);
  auto list = pipelines::read_manifest(directory).value();
  for (const char* name : {"summary.json", "report.html"})
    list[name] = pipelines::listed_now(directory, name);
  write_bytes(results / pipelines::manifest_name, pipelines::manifest_text(list));
}

/// gmsh stays out of this process: it is forked later.
void add_imports(Samples& samples, const fs::path& directory) {
  const auto end = meshes::run_apart(
      [&] {
        write_import_samples(directory);
        return std::string("written");
      },
      60);
  if (end.result != "written") throw std::runtime_error("gmsh made no samples: " + end.log);
  samples.steps = {undated(read_bytes(directory / "sound.step"))};
  samples.meshes = {read_bytes(directory / "sound_41.msh"), read_bytes(directory / "sound_22.msh")};
}

void add_kept_files(Samples& samples, const fs::path& directory) {
  pipelines::write_unit_responses(directory / "r.h5", kept_key, results_test::example_responses());
  samples.responses = read_bytes(directory / "r.h5");
}

void add_results(Samples& samples, const fs::path& directory, const fs::path& program) {
  write_bytes(directory / "belt_pull.csv", samples.sound_table);
  const auto add = [&](const std::string& scene, const std::vector<std::string>& more) {
    write_bytes(directory / "scene.toml", scene);
    fs::remove_all(directory / "results");
    std::vector<std::string> arguments{"run", "scene.toml", "-q", "-o", "results"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto end = run_program(program, arguments, directory, directory, 60);
    if (end.exit_code != 0) throw std::runtime_error("a sample is refused: " + end.err);
    set_timing(directory / "results");
    samples.results.push_back(all_files(directory / "results"));
  };
  for (const auto& scene : samples.beam_scenes)
    add(scene, {"--method", "beam", "--threads", "1", "--tolerance", "none"});
  add(samples.table_scene, {});
  add(source_file("pipelines/scenes/drive_train.toml"), {});
}

}  // namespace

Samples make_samples(const fs::path& directory, const fs::path& program) {
  fs::create_directories(directory);
  Samples samples;
  for (const char* name :
       {"vibratory_mill", "planetary_mill", "drive_train", "load_table", "stub_axle", "root_peeler_shaft"})
    samples.scenes.push_back(source_file("pipelines/scenes/" + std::string(name) + ".toml"));
  for (const char* name :
       {"axle", "chamber", "drum", "mill", "part", "planetary", "table", "train", "train_shaft"})
    samples.scenes.push_back(base_scene(std::string(name) + ".toml"));
  samples.table_scene = source_file("tests/fuzz/samples/table.toml");
  samples.beam_scenes = {source_file("tests/fuzz/samples/shaft.toml")};
  samples.scenes.insert(samples.scenes.end(), {samples.table_scene, samples.beam_scenes.front()});
  samples.sound_table = source_file("pipelines/scenes/belt_pull.csv");
  samples.tables = {samples.sound_table, logged_table(';'), logged_table('\t'), logged_table(',')};
  add_imports(samples, directory);
  add_kept_files(samples, directory);
  add_results(samples, directory, program);
  return samples;
}

}  // namespace fuzz
