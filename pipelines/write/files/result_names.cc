#include "pipelines/write/files/result_names.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <utility>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/run_record.h"
#include "pipelines/write/living/living_page.h"

namespace pipelines {
namespace {

const std::string page_name = "report.html", torsion_folder = "torsion";

/// A result in a body's folder.
bool is_body_file(const std::string& name) {
  static const std::regex given(
      R"(mesh\.msh|unit_responses\.h5|(zones|zone_tree|hot_spots|fatigue|weld_fatigue|diagrams|torsion|torsion_cycle|element_torques|start_up|campbell)\.csv|campbell\.(png|svg)|)"
      R"(envelope(\.vtu|\.pvtu|\.png|_\d+\.vtu)|cycle\.pvd|cycle_\d+\.vtu)");
  return std::regex_match(name, given);
}

/// The folder of a file, empty for the directory itself, and its name there.
std::pair<std::string, std::string> folder_and_file(const std::string& name) {
  const std::filesystem::path path(name);
  return {path.parent_path().generic_string(), path.filename().string()};
}

}  // namespace

OutputNames names_of(std::vector<std::string> names) {
  return {[names](const std::string& name) { return contains(names, name); },
          [names](const std::string& folder) {
            return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
              return name.compare(0, folder.size() + 1, folder + '/') == 0;
            });
          }};
}

OutputNames names_like(const std::string& form) {
  return {[names = std::regex(form)](const std::string& name) { return std::regex_match(name, names); },
          [](const std::string&) { return false; }};
}

OutputNames run_names(std::vector<std::string> bodies) {
  return {[](const std::string& name) { return name == page_name || is_run_result(name); },
          [bodies = std::move(bodies)](const std::string& folder) {
            return folder == torsion_folder || contains(bodies, folder);
          }};
}

bool is_run_result(const std::string& name) {
  const auto [folder, file] = folder_and_file(name);
  if (folder.empty())
    return contains({"summary.json", living_data_name, "loads.h5", "loads.csv", "duty.csv", run_record_name,
                     "bodies.vtm", "paraview_view.py"},
                    file);
  if (folder == torsion_folder && contains(torsion_files(), file)) return true;
  return folder.find('/') == std::string::npos && is_body_file(file);
}

}  // namespace pipelines
