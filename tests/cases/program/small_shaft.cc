#include "tests/cases/program/small_shaft.h"

namespace cases {

std::vector<SmallLoad> fixed_in_space(const std::string& effect, const std::string& port,
                                      const std::string& force) {
  return {{effect, port + ".fx", force, 1}, {effect, port + ".fy", force, 1, "90 deg"}};
}

std::string small_shaft(const std::vector<SmallLoad>& loads, const std::string& unit,
                        const std::string& speed, const std::string& keys) {
  std::string effects, entries;
  for (const auto& load : loads) {
    const auto name = "\"" + load.effect + "\"";
    if (effects.find(name) == std::string::npos) effects += (effects.empty() ? "" : ", ") + name;
    entries += load.order == 0 ? "[[machine.constants]]\n" : "[[machine.harmonics]]\n";
    entries += "effect = \"" + load.effect + "\"\nload = \"" + load.load + "\"\n";
    entries += (load.order == 0 ? "value" : "amplitude") + (" = \"" + load.size) + "\"\n";
    if (load.order > 0) entries += "order = " + std::to_string(load.order) + "\n";
    if (!load.phase.empty()) entries += "phase = \"" + load.phase + "\"\n";
  }
  const auto segment = [&](const std::string& what, const std::string& length) {
    return "  { " + what + ", diameter = \"10 " + unit + "\", length = \"" + length + " " + unit + "\" },\n";
  };
  return "title = \"Small shaft\"\neffects = [" + effects +
         "]\n[machine]\ntype = \"load_table\"\nspeed = \"" + speed + "\"\n" + entries +
         "[sampling]\ninstants_per_turn = 24\nturns = 1\n[shaft]\ncontour = [\n" +
         segment("port = \"bearing_1\"", "4") + segment("name = \"left\"", "188") +
         segment("port = \"middle\"", "20") + segment("name = \"right\"", "188") +
         segment("port = \"bearing_2\"", "4") +
         "]\nbearings = [\"bearing_1\", \"bearing_2\"]\ntorque_support = \"bearing_2\"\n" + keys +
         "\n[shaft.material]\nname = \"steel\"\nyoungs_modulus = \"206 GPa\"\npoisson_ratio = 0.3\n"
         "density = \"7850 kg/m3\"\nyield_strength = \"305 MPa\"\n[shaft.mesh]\nsectors = 8\nlargest_cell = "
         "\"20 " +
         unit + "\"\n[results]\nsnapshots = 0\npictures = false\n";
}

nlohmann::json run_small(const fs::path& directory, const std::string& scene, std::string* out) {
  write(directory / "scene.toml", scene);
  const auto outcome = millstress(directory, "run scene.toml -o out -v");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  if (out != nullptr) *out = outcome.out;
  return outcome.exit_code == 0 ? summary(directory / "out") : nlohmann::json();
}

}  // namespace cases
