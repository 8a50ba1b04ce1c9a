/// The whole program as a user starts it: exit codes, messages, and what it leaves.
#include <nlohmann/json.hpp>

#include <algorithm>

#include "pipelines/write/files/manifest.h"
#include "tests/fuzz/child.h"
#include "tests/fuzz/kinds/results_cases.h"
#include "tests/fuzz/kinds/samples.h"
#include "tests/fuzz/verdicts.h"

namespace fuzz {
namespace {

using Words = std::vector<std::string>;

/// Columns of numbers have a number in every row.
std::string fault_of_table(const std::string& name, const std::string& text) {
  for (const char* word : {",nan", ",-nan", ",inf", ",-inf"})
    if (text.find(word) != std::string::npos) return name + " holds what is not finite";
  if (text.empty() || text.back() != '\n') return name + " is not whole";
  return "";
}

/// Of what a command has written that ended with exit code 0.
std::string fault_of_outputs(const std::string& command, const std::filesystem::path& directory) {
  for (const auto& [name, bytes] : all_files(directory)) {
    const auto extension = std::filesystem::path(name).extension();
    if (extension == ".csv" && name != "belt_pull.csv")
      if (auto fault = fault_of_table(name, bytes); !fault.empty()) return fault;
  }
  if (command != "run") return "";
  const auto results = directory / "results";
  if (nlohmann::json::parse(read_bytes(results / "summary.json"), nullptr, false).is_discarded())
    return "summary.json is no JSON";
  const auto check = pipelines::check_manifest(results);
  if (!check.is_there || check.is_mixed() || !check.missing.empty()) return "the results are not whole";
  return "";
}

/// @param named  files of which a refusal has to name one
Verdict program_judged(const Words& arguments, const Words& named, const Place& place) {
  const auto before = all_files(place.directory);
  const auto end =
      run_program(place.program, arguments, place.directory, place.outside, place.seconds_of_core);
  std::string command = "millstress";
  for (const auto& word : arguments) command += " " + word;
  const auto verdict_with = [&](const std::string& fault) {
    return Verdict{end.exit_code == 0, fault.empty() ? "" : command + ": " + fault + "\n" + end.err};
  };
  if (end.signal != 0) return verdict_with("ended by signal " + std::to_string(end.signal));
  if (end.exit_code != 0 && (end.exit_code < 2 || end.exit_code > 4))
    return verdict_with("exit code " + std::to_string(end.exit_code));
  if (auto fault = fault_of_leftovers(place.directory); !fault.empty()) return verdict_with(fault);
  if (end.exit_code == 0) return verdict_with(fault_of_outputs(arguments.front(), place.directory));
  if (auto fault = fault_of_message(end.err, named); !fault.empty()) return verdict_with(fault);
  const auto name = difference(before, all_files(place.directory));
  return verdict_with(name.empty() ? "" : name + " is touched");
}

const Words by_beam = {"run",  "scene.toml", "-q", "-o",          "results", "--method",
                       "beam", "--threads",  "1",  "--tolerance", "none"};

/// Commands for scenes without a body, which take milliseconds beside the program's start.
const std::vector<Words> short_commands = {
    {"loads", "scene.toml", "-q", "--csv", "loads.csv", "-o", "loads.h5"},
    {"loads", "scene.toml", "-q", "--statistics", "statistics", "--calculix", "cards"},
    {"loads", "scene.toml", "--json"},
    {"check", "scene.toml"},
    {"effects", "scene.toml"},
    {"torsion", "scene.toml"},
    {"springs", "scene.toml"},
    {"extremes", "scene.toml"},
    {"run", "scene.toml", "-q", "-o", "results"}};

std::string without_bodies(const std::string& scene) {
  auto end = scene.size();
  for (const char* body : {"\n[shaft]", "\n[chamber]", "\n[drum]", "\n[axle]", "\n[part]"})
    end = std::min(end, scene.find(body));
  return scene.substr(0, end) + "\n";
}

}  // namespace

Verdict program_case(Mutator& random, const Place& place) {
  const auto& samples = place.samples;
  const bool has_body = random.one_in(4);
  auto scene = has_body ? random.one_of(samples.beam_scenes) : without_bodies(random.one_of(samples.scenes));
  auto table = samples.sound_table;
  if (random.one_in(5) && scene.find("belt_pull.csv") != std::string::npos)
    table = random.damage(table, Grammar::csv, random.one_of(samples.tables));
  else
    scene = random.damage(scene, Grammar::toml, random.one_of(samples.scenes));
  write_bytes(place / "belt_pull.csv", table);
  write_bytes(place / "scene.toml", scene);
  return program_judged(has_body ? by_beam : random.one_of(short_commands), {"scene.toml", "belt_pull.csv"},
                        place);
}

Verdict program_again_case(Mutator& random, const Place& place) {
  write_damaged_results(random, place, place / "results");
  write_bytes(place / "belt_pull.csv", place.samples.sound_table);
  if (random.one_in(2)) return program_judged({"report", "results"}, {"results"}, place);
  write_bytes(place / "scene.toml", place.samples.beam_scenes.front());
  return program_judged(by_beam, {"results"}, place);
}

}  // namespace fuzz
