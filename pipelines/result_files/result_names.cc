#include "pipelines/result_files/result_names.h"

#include <nlohmann/json.hpp>
#include <regex>

#include "pipelines/common/errors.h"
#include "pipelines/files/json_file.h"
#include "pipelines/files/replaceable.h"
#include "pipelines/machine_reports/torsion_report.h"
#include "pipelines/names/name_lists.h"
#include "pipelines/result_files/manifest.h"
#include "pipelines/result_files/run_record.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

const std::string summary_name = "summary.json";
const std::string torsion_folder = "torsion";

bool is_run_file(const std::string& name) {
  return contains(
      {summary_name, "report.html", "loads.h5", "loads.csv", "duty.csv", manifest_name, run_record_name},
      name);
}

bool is_torsion_file(const std::string& name) {
  return contains(torsion_files(), name);
}

using SummaryJson = nlohmann::ordered_json;

SummaryJson part(const SummaryJson& of, const char* key) {
  return of.is_object() && of.contains(key) ? of.at(key) : SummaryJson();
}

SummaryJson summary_of_program(const fs::path& file) {
  auto json = read_json_file(file);
  return part(part(json, "program"), "name") == "millstress" ? json : SummaryJson();
}

class ForeignFiles {
public:
  explicit ForeignFiles(const fs::path& directory)
      : written_before_(fs::exists(directory / manifest_name) ||
                        !summary_of_program(directory / summary_name).is_null()) {}

  template <typename IsOurs>
  void refuse_in(const fs::path& folder, IsOurs is_ours) const {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      const auto name = entry.path().filename().string();
      if (!is_ours(name)) continue;
      require_replaceable(entry.path());
      if (!written_before_ && !is_kept_file(name))
        throw OptionError("-o " + entry.path().string() +
                          ": is there already, and no run of this program has left its manifest.json beside "
                          "it; move the file away, or choose another directory with -o");
    }
  }

private:
  bool written_before_;
};

/// A folder that is a link may lead to files of others.
void refuse_link(const fs::path& folder) {
  if (fs::is_symlink(folder)) require_replaceable(folder);
}

}  // namespace

bool is_body_file(const std::string& name) {
  static const std::regex given(
      R"(mesh\.msh|unit_(responses|harmonics)\.h5|iteration_gave_up\.txt|(zones|zone_tree|hot_spots|fatigue|weld_fatigue|diagrams|torsion|torsion_cycle|element_torques|start_up)\.csv|)"
      R"(envelope(\.vtu|\.pvtu|\.png|_\d+\.vtu)|cycle\.pvd|cycle_\d+\.vtu)");
  return std::regex_match(name, given);
}

bool is_kept_file(const std::string& name) {
  return name == "unit_responses.h5" || name == "unit_harmonics.h5" || name == "iteration_gave_up.txt";
}

void refuse_foreign_files(const fs::path& directory, const std::vector<std::string>& bodies) {
  const ForeignFiles foreign(directory);
  foreign.refuse_in(directory, is_run_file);
  refuse_link(directory / torsion_folder);
  foreign.refuse_in(directory / torsion_folder, is_torsion_file);
  for (const auto& body : bodies) {
    refuse_link(directory / body);
    foreign.refuse_in(directory / body, is_body_file);
  }
}

std::vector<std::string> bodies_of_summary(const fs::path& file) {
  std::vector<std::string> names;
  const auto bodies = part(summary_of_program(file), "bodies");
  for (const auto& body : bodies.items()) names.push_back(body.key());
  return names;
}

}  // namespace pipelines
