#include "pipelines/study/variations/sweep_request.h"

#include <utility>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {
namespace {

constexpr const char* designs = "write \"grid\", \"one-at-a-time\" or \"latin-hypercube\"";

/// Whatever was refused as an option is refused at the scene's key.
template <typename Read>
void at_key(SceneTable& table, const std::string& key, const Read& read) {
  try {
    read();
  } catch (const OptionError& error) {
    table.refuse(key, error.what());
  }
}

}  // namespace

SweepDesign sweep_design(const std::string& text) {
  std::vector<std::string> names;
  for (const auto design : {SweepDesign::grid, SweepDesign::one_at_a_time, SweepDesign::latin_hypercube}) {
    if (text == to_string(design)) return design;
    names.push_back(to_string(design));
  }
  const auto nearest = nearest_name(text, names);
  throw OptionError("--design " + text + ": is no design" +
                    (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?") + "; " + designs);
}

SweepRequest read_sweep_request(const std::filesystem::path& file, const TomlNode& tree) {
  SceneFindings findings;
  findings.file = file.string();
  SceneTable root(tree, "", findings);
  SceneTable table = root.table_or_empty("sweep");
  SweepRequest request;
  for (const auto& [key, texts] : {std::pair{"vary", &request.vary}, {"figures", &request.figures}}) {
    table.know(key);
    if (table.has(key))
      for (const auto& text : table.texts(key)) texts->push_back(text.text);
  }
  const auto design = table.text_or("design", "grid", "every value with every other");
  at_key(table, "design", [&] { request.design = sweep_design(design); });
  request.n_points = table.count_or("points", 2, 1'000'000, 0, "a grid has as many as its values make");
  request.seed = std::uint64_t(table.count_or("seed", 0, 1'000'000'000, 1, "any other draws other points"));
  request.zones =
      table.flag_or("zones", false, "the largest stress of every place tells most, and costs less");
  table.finish();
  if (!request.vary.empty() && findings.errors.empty())
    at_key(table, "vary", [&] { (void)plan_sweep(request); });
  if (!findings.errors.empty()) throw SceneError(std::move(findings.errors));
  return request;
}

}  // namespace pipelines
