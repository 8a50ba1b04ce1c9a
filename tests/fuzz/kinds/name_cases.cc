/// Names as people, programs and other people's programs give them, in scenes of every machine: refused at
/// their place, or carried by every file.
#include <algorithm>
#include <regex>
#include <set>

#include "pipelines/base/files/hdf5_file.h"
#include "pipelines/loads/channels/load_files.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/tables/table_file.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/fuzz/kinds/samples.h"
#include "tests/fuzz/kinds/scene_cases.h"
#include "tests/fuzz/verdicts.h"

namespace fuzz {
namespace {

/// As a basic string of TOML has them.
const std::vector<std::string>& hard_names() {
  static const std::vector<std::string> names{"R&D",
                                              "<b>x</b>",
                                              "a > b",
                                              "it's",
                                              R"(6\" pipe)",
                                              "]]>",
                                              "<!--",
                                              "&amp;",
                                              "&#0;",
                                              "$x^2$",
                                              "a|b",
                                              "%s%n%d",
                                              "{}",
                                              "{0:.3f}",
                                              R"(a\\b)",
                                              "a,b",
                                              "a;b",
                                              "a [N]",
                                              "#1",
                                              "=1+1",
                                              "+a",
                                              "-a",
                                              "@a",
                                              ".",
                                              "..",
                                              "...",
                                              ".a",
                                              "a.",
                                              "a.fx",
                                              "a/b",
                                              "/",
                                              "../../x",
                                              "~",
                                              "*",
                                              "?",
                                              " ",
                                              " a",
                                              "a ",
                                              R"(a\tb)",
                                              R"(a\nb)",
                                              R"(a\u0000)",
                                              R"(\u001B[31m)",
                                              R"(a\u007F)",
                                              R"(a\u0085b)",
                                              R"(a\u2028b)",
                                              R"(\u202Eb)",
                                              R"(\uFFFF)",
                                              R"(\uFEFFa)",
                                              R"(e\u0301)",
                                              "\u00e4\u00f6",
                                              "\u65e5\u672c",
                                              R"(\U0001F600)",
                                              "nan",
                                              "null",
                                              "true",
                                              "1e5",
                                              "0",
                                              "time",
                                              "phi",
                                              "total",
                                              "shaft",
                                              "volume",
                                              "end_1",
                                              "summary.json",
                                              "con"};
  return names;
}

std::string drawn_name(Mutator& random) {
  if (random.one_in(10)) return std::string(1 + random.below(300), 'n');
  const auto& names = hard_names();
  auto name = random.one_of(names);
  return random.one_in(3) ? name + random.one_of(names) : name;
}

/// Every text that a scene gives to one of these keys, each once.
std::vector<std::string> names_in(const std::string& scene) {
  static const std::regex given(R"re(\b(?:name|port|bore_port|effect|title|shaft)\s*=\s*"([^"\\]+)")re");
  std::set<std::string> names;
  for (std::sregex_iterator at(scene.begin(), scene.end(), given), end; at != end; ++at)
    names.insert((*at)[1].str());
  return {names.begin(), names.end()};
}

std::string with_name(std::string scene, const std::string& old, const std::string& name) {
  for (auto at = scene.find('"' + old); at != std::string::npos;
       at = scene.find('"' + old, at + name.size() + 1)) {
    const auto end = at + 1 + old.size();
    // A load is "<port>.<component>".
    if (end < scene.size() && (scene[end] == '"' || scene[end] == '.'))
      scene.replace(at + 1, old.size(), name);
  }
  return scene;
}

/// What a scene that is accepted writes has its names.
std::string fault_of_files(const Place& place) {
  auto scene = pipelines::read_scene(place / "scene.toml");
  if (!scene.masses_from_mesh.empty()) return "";
  scene.sampling = few_instants(scene);
  const auto loads = pipelines::load_stage(scene, scene.machine);
  pipelines::write_loads_h5(place / "loads.h5", loads, {});
  const pipelines::Hdf5Reader read(place / "loads.h5");
  if (read.texts("/effect_names") != loads.effects) return "loads.h5 has other names of effects";
  for (const auto& resultant : loads.resultants)
    for (const auto& part : resultant.contributions)
      if (!read.has("/effects/" + loads.effects[part.effect] + "/" + resultant.role + "/fx"))
        return "loads.h5 lacks " + loads.effects[part.effect] + " of " + resultant.role;
  pipelines::write_loads_csv(place / "loads.csv", loads, {});
  pipelines::read_table_file(place / "loads.csv");
  return "";
}

}  // namespace

Verdict name_case(Mutator& random, const Place& place) {
  auto scene = random.one_of(place.samples.scenes);
  const auto names = names_in(scene);
  for (std::size_t n = 1 + random.below(2); n > 0 && !names.empty(); --n)
    scene = with_name(scene, random.one_of(names), drawn_name(random));
  write_bytes(place / "belt_pull.csv", place.samples.sound_table);
  write_bytes(place / "scene.toml", scene);
  return judged(place.directory.string(), [&] {
    if (auto fault = fault_of_scene(place / "scene.toml"); !fault.empty()) return fault;
    return fault_of_files(place);
  });
}

}  // namespace fuzz
