/// Result directories with damage: as `report` and the next run look at them.
#include "tests/fuzz/kinds/results_cases.h"

#include "pipelines/base/common/errors.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/report/html_report.h"
#include "tests/fuzz/kinds/samples.h"
#include "tests/fuzz/verdicts.h"

namespace fuzz {

void write_damaged_results(Mutator& random, const Place& place, const std::filesystem::path& directory) {
  auto files = random.one_of(place.samples.results);
  // Most often those that are read: without a manifest the summary's own reader has to see the damage.
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files) names.push_back(name);
  const auto name = random.one_in(4)   ? random.one_of(names)
                    : random.one_in(3) ? std::string(pipelines::manifest_name)
                                       : std::string("summary.json");
  const auto& other = random.one_of(place.samples.results).at("summary.json");
  const bool is_json = std::filesystem::path(name).extension() == ".json";
  files[name] = random.damage(files[name], is_json ? Grammar::json : Grammar::bytes, other);
  if (name == "summary.json" && !random.one_in(8)) files.erase(pipelines::manifest_name);
  for (const auto& [file, bytes] : files) {
    std::filesystem::create_directories((directory / file).parent_path());
    write_bytes(directory / file, bytes);
  }
}

namespace {

/// What `report` does.
std::string fault_of_report(const std::filesystem::path& directory) {
  pipelines::finish_exchange(directory);
  if (const auto check = pipelines::check_manifest(directory); check.is_mixed())
    throw pipelines::OptionError(check.text(directory));
  pipelines::publish_html_report(directory, directory / "accuracy", "report");
  const auto page = read_bytes(directory / "report.html");
  const std::string end = "</html>\n";
  if (page.size() < end.size() || page.compare(page.size() - end.size(), end.size(), end) != 0)
    return "report.html is not whole";
  return "";
}

}  // namespace

Verdict results_case(Mutator& random, const Place& place) {
  const auto directory = place / "results";
  write_damaged_results(random, place, directory);
  auto before = all_files(directory);
  auto verdict = judged("results", [&] {
    const pipelines::StagedResults next_run(directory,
                                            pipelines::run_names({"shaft"}));  // looks, and publishes nothing
    return std::string();
  });
  if (!verdict.fault.empty()) return verdict;
  if (const auto name = difference(before, all_files(directory)); !name.empty())
    return {false, name + " is changed by a run that writes nothing"};
  verdict = judged("results", [&] { return fault_of_report(directory); });
  if (!verdict.fault.empty()) return verdict;
  auto after = all_files(directory);
  if (verdict.accepted) {
    after.erase("report.html");
    before.erase("report.html");
  }
  if (const auto name = difference(before, after); !name.empty())
    verdict.fault = name + " is changed by a report";
  return verdict;
}

}  // namespace fuzz
