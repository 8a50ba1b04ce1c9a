/// All shipped scenes with effects = "auto" and with every single effect, and every two, removed: what is
/// left is refused, or its loads close on every body. Loads and closure on coarse meshes, nothing is solved.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/body_effects.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "tests/unit/pipelines/examples/bodies.h"
#include "tests/unit/pipelines/examples/results_directory.h"
#include "tests/unit/pipelines/examples/shared_environment.h"

using namespace pipelines;

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

std::string quoted(const Names& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "\"" : ", \"") + name + "\"";
  return "[" + list + "]";
}

Names without(Names names, const Names& off) {
  for (const auto& name : off) names.erase(std::remove(names.begin(), names.end(), name), names.end());
  return names;
}

/// The coarsest meshes that keep every port, and few instants.
void make_coarse(Scene& scene) {
  scene.sampling = {std::holds_alternative<kinetics::LoadTable>(scene.machine) ? scene.sampling.turns : 1,
                    24};
  for (auto& body : scene.bodies) {
    if (auto* shaft = std::get_if<ShaftShape>(&body.shape)) {
      shaft->mesh.cells_per_fillet_quarter = 2;
      shaft->mesh.n_sectors = shaft->mesh.n_sectors > 16 ? 12 : 8;
    }
    if (auto* chamber = std::get_if<ChamberShape>(&body.shape)) {
      chamber->mesh.cells_through_wall = 1;
      chamber->mesh.size_m = 0.04;
    }
  }
}

/// A shipped scene, coarse, with the meshes of its bodies: they do not depend on its effects.
struct Shipped {
  explicit Shipped(const std::string& name) : text(results_test::bytes(folder() / name)) {
    for (const char* input : {"belt_pull.csv", "part.step"}) fs::copy(folder() / input, at / input);
    scene = read(scene_text("\"all\"")).value();
    shared::start_fem();
    meshes = mesh_bodies(scene);
    masses = agree_masses(scene, meshes);
  }
  static fs::path folder() { return fs::path(SOURCE_DIR) / "pipelines/scenes"; }

  std::string scene_text(const std::string& effects) const {
    const auto begin = text.find("effects = ["), end = text.find(']', begin);
    return std::string(text).replace(begin, end + 1 - begin, "effects = " + effects);
  }
  /// Empty if the scene is refused; `refusal` then has the words.
  std::optional<Scene> read(const std::string& scene_text) {
    std::ofstream(at / "scene.toml", std::ios::binary) << scene_text;
    try {
      auto read = read_scene(at / "scene.toml");
      make_coarse(read);
      return read;
    } catch (const SceneError& errors) {
      refusal = errors.what();
      return std::nullopt;
    }
  }

  results_test::Directory at;
  std::string text, refusal;
  Scene scene;  ///< with all effects
  std::vector<MeshedBody> meshes;
  MassAgreement masses;
};

/// By the test's own sums, not those of the choice.
bool closes(const Scene& scene, const Shipped& shipped) {
  const auto& meshed = shipped.meshes;
  const auto trial = try_effects(scene, meshed, shipped.masses);
  bool all = true;
  for (std::size_t i = 0; i < meshed.size(); ++i) {
    const auto closure = bodies::closure_of(trial.bodies[i], meshed[i].regions);
    all = all && !trial.bodies[i].unit_loads.empty() && closure.worst_force() < 1e-9 &&
          closure.worst_moment() < 1e-9 && closure.channel_resultant < 1e-9;
  }
  return all;
}

/// What lies under the scene's refusals: the machine itself refuses these effects, or a body would not close.
bool cannot_run(Scene scene, const Names& effects, const Shipped& shipped) {
  scene.effects = effects;
  try {
    return !closes(scene, shipped);
  } catch (const std::invalid_argument&) {
    return true;
  }
}

/// @return whether the scene runs with these effects
bool expect_closed_or_refused(Shipped& shipped, const Names& effects) {
  const auto scene = shipped.read(shipped.scene_text(quoted(effects)));
  if (!scene) {
    EXPECT_NE(shipped.refusal.find("needs the effect \""), std::string::npos) << shipped.refusal;
    EXPECT_NE(shipped.refusal.find("scene.toml:"), std::string::npos) << shipped.refusal;
    EXPECT_TRUE(cannot_run(shipped.scene, effects, shipped)) << "refused in vain: " << shipped.refusal;
    return false;
  }
  const auto& meshed = shipped.meshes;
  EXPECT_NO_THROW(require_equilibrium(*scene, meshed, shipped.masses,
                                      try_effects(*scene, meshed, shipped.masses).bodies));
  EXPECT_TRUE(closes(*scene, shipped));
  return true;
}

}  // namespace

class ShippedEffects : public testing::TestWithParam<std::string> {};

TEST_P(ShippedEffects, ClosesWithoutAnySingleEffectAndAnyTwoOrIsRefused) {
  Shipped shipped(GetParam());
  const Names all = shipped.scene.effects;
  std::size_t n_runs = 0, n_refused = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i; j < all.size(); ++j) {
      const Names left = without(all, {all[i], all[j]});
      if (left.empty()) continue;
      SCOPED_TRACE("without " + all[i] + " and " + all[j]);
      ++(expect_closed_or_refused(shipped, left) ? n_runs : n_refused);
      if (HasFailure()) return;
    }
  EXPECT_GT(n_runs, 0u);
  const auto table = effect_table(shipped.scene);
  EXPECT_EQ(n_refused > 0, std::any_of(table.begin(), table.end(), [&](const auto& info) {
              return !info.needs.empty() && shipped.scene.has_effect(info.name);
            }));
}

// From what is nothing to almost everything: "auto" ends at a set that closes, whatever may go.
TEST_P(ShippedEffects, ClosesWithEffectsChosen) {
  Shipped shipped(GetParam());
  const auto open = shipped.read(shipped.scene_text("\"auto\""));
  ASSERT_TRUE(open) << shipped.refusal;
  for (const double limit : {0.0005, 0.005, 0.05, 0.3, 0.9, 0.999}) {
    SCOPED_TRACE(limit);
    const Scene chosen = with_effects_chosen(*open, shipped.meshes, limit);
    EXPECT_TRUE(has_what_it_needs(chosen));
    EXPECT_TRUE(closes(chosen, shipped));
    EXPECT_EQ(chosen.effects.size() + chosen.effect_choice.dropped.size(), open->effects.size());
    // Each that comes back brings along what it went with.
    for (const auto& dropped : chosen.effect_choice.dropped)
      EXPECT_TRUE(closes(with_effect_back(chosen, dropped.effect), shipped)) << dropped.effect;
  }
}

namespace {

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(Shipped::folder()))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(shipped, ShippedEffects, testing::ValuesIn(shipped_scenes()),
                         [](const auto& test) { return test.param.substr(0, test.param.find('.')); });
