/// Which effects a body cannot be without, and how a scene is refused that leaves them out.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/body_effects.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/study/effects/body_effect_report.h"
#include "tests/unit/pipelines/examples/edited_scene.h"
#include "tests/unit/pipelines/examples/plain_body.h"

using namespace pipelines;

namespace {

using Names = std::vector<std::string>;

/// A scene whose one body is a plain shaft.
struct MeshedScene {
  explicit MeshedScene(Scene given) : scene(std::move(given)), meshed{plain::meshed(scene.bodies.front())} {
    scene.sampling = {1, 24};
    masses = agree_masses(scene, meshed);
  }
  std::string refusal() const {
    try {
      require_equilibrium(scene, meshed, masses, try_effects(scene, meshed, masses).bodies);
    } catch (const SceneError& errors) {
      return errors.what();
    }
    return "accepted";
  }
  Scene scene;
  std::vector<MeshedBody> meshed;
  MassAgreement masses;
};

const edited::Edits constant_torques{
    {"constant = \"3.744 N m\"", "constant = \"3 N m\""},
    {"constant = \"-9.984 N m\"", "constant = \"-6 N m\""},
    {"harmonics = [{ amplitude = \"3.744 N m\", frequency = \"50 Hz\" }]", ""},
    {"harmonics = [{ amplitude = \"-9.6 N m\", frequency = \"50 Hz\" }]", ""}};
const edited::Edits without_inertia{{"  \"shaft_inertia\", ", "  "}};

/// Takes [machine.transient] out: a start accelerates the shaft whatever the torques of steady running do.
edited::Edits without_start() {
  const auto text =
      results_test::bytes(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/root_peeler_shaft.toml");
  const auto begin = text.find("[machine.transient]"), end = text.find("[sampling]");
  return {{text.substr(begin, end - begin), ""}};
}

edited::Edits operator+(edited::Edits a, const edited::Edits& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

const BodyEffect& of(const std::vector<BodyEffect>& effects, const std::string& name) {
  for (const auto& effect : effects)
    if (effect.effect.name == name) return effect;
  throw std::out_of_range(name);
}

}  // namespace

// T_34 - T_45 = J phi'': each torque that varies needs the shaft's inertia, the forces across do not.
TEST(EffectEquilibrium, VaryingTorquesNeedTheShaftsInertia) {
  const Scene scene = plain::scene("root_peeler_shaft");
  std::set<std::string> open;
  for (const auto& need : open_needs(effect_table(scene), {"motor_torque", "peeling_torque", "belt_pull"})) {
    open.insert(need.effect);
    EXPECT_EQ(need.need.effect, "shaft_inertia");
  }
  EXPECT_EQ(open, (std::set<std::string>{"motor_torque", "peeling_torque"}));
  EXPECT_THROW(edited::scene("root_peeler_shaft", without_inertia), SceneError);
  // Without the shaft as a body nothing needs it.
  EXPECT_TRUE(open_needs(effect_table(plain::scene("drive_train")), {"motor_torque"}).empty());
}

// Constant torques in balance, 3 N m through a belt that turns the shaft 0.375 times as fast less 8 N m, run
// without the inertia; -6 N m leaves 2 N m that accelerate the whole train. No table can tell that from a
// name: the loads do, and the refusal says what would help.
TEST(EffectEquilibrium, ConstantTorquesThatDoNotBalanceAreRefused) {
  auto balanced = constant_torques + without_inertia + without_start();
  balanced[1].second = "constant = \"-8 N m\"";
  EXPECT_EQ(MeshedScene(edited::scene("root_peeler_shaft", balanced)).refusal(), "accepted");

  const MeshedScene open(
      edited::scene("root_peeler_shaft", constant_torques + without_inertia + without_start()));
  const auto text = open.refusal();
  EXPECT_NE(text.find("scene.toml:6:11: effects = [\"motor_torque\", \"peeling_torque\", \"belt_pull\""),
            std::string::npos)
      << text;
  EXPECT_TRUE(
      ends_with(text,
                ": the shaft is not in equilibrium: the loads of \"motor_torque\" and \"peeling_torque\" "
                "leave torques about z that nothing balances; add \"shaft_inertia\", or remove "
                "\"motor_torque\" and \"peeling_torque\""))
      << text;
  // `run` says the same words.
  StageClock clock;
  try {
    load_bodies(open.scene, open.meshed, clock);
    ADD_FAILURE();
  } catch (const SceneError& errors) {
    EXPECT_EQ(errors.what(), text);
  }
}

// What no table knows is found by the body's equilibrium: without the inertia both torques have to go.
TEST(EffectEquilibrium, ClosedSetsAreFoundByTheLoads) {
  const MeshedScene all(edited::scene("root_peeler_shaft", constant_torques + without_start()));
  const auto closed = [](const MeshedScene& given, const Names& off) {
    const auto set = closed_set(given.scene, given.meshed, given.masses, off);
    return set ? set->off : Names{"none"};
  };
  EXPECT_EQ(closed(all, {"belt_pull"}), Names{"belt_pull"});
  EXPECT_EQ(closed(all, {"motor_torque"}), Names{"motor_torque"});
  EXPECT_EQ(closed(all, {"shaft_inertia"}), Names{"none"}) << "no effect of the train would be left";
  const edited::Edits idle{
      {"[[machine.excitations]]\nname = \"motor_torque\"",
       "[[machine.excitations]]\nname = \"idle\"\ninertia = \"disc\"\nconstant = \"0 N m\"\n\n"
       "[[machine.excitations]]\nname = \"motor_torque\""},
      {"  \"motor_torque\", ", "  \"idle\", \"motor_torque\", "}};
  const MeshedScene more(edited::scene("root_peeler_shaft", constant_torques + idle + without_start()));
  EXPECT_EQ(closed(more, {"shaft_inertia"}), (Names{"motor_torque", "peeling_torque", "shaft_inertia"}));
  // A start accelerates the shaft whatever these torques do, and it goes with none of them.
  const MeshedScene starting(edited::scene("root_peeler_shaft", constant_torques + idle));
  EXPECT_EQ(closed(starting, {"shaft_inertia"}), Names{"none"});
}

// The mistake that was seen: the inertia's share of the loads is 1e-5, and it was dropped.
TEST(EffectEquilibrium, TheChoiceKeepsWhatBalances) {
  MeshedScene auto_scene(
      edited::scene("root_peeler_shaft", {{"effects = [\n  \"motor_torque\", \"peeling_torque\",\n"
                                           "  \"shaft_inertia\",                  # the shaft's own "
                                           "mass takes part in the vibration\n"
                                           "  \"belt_pull\", \"disc_imbalance\", \"disc_weight\",\n]",
                                           "effects = \"auto\""}}));
  for (const double limit : {0.005, 0.1, 0.9}) {
    MeshedScene chosen = auto_scene;
    chosen.scene = with_effects_chosen(chosen.scene, chosen.meshed, limit);
    EXPECT_EQ(chosen.refusal(), "accepted") << limit;
    EXPECT_TRUE(chosen.scene.has_effect("shaft_inertia")) << limit;
  }
}

// A table's torque that no port takes: the support is named, and the effects that need it.
TEST(EffectEquilibrium, MissingSupportsAreNamed) {
  const MeshedScene table(edited::scene("load_table", {{"torque_support = \"disc_seat\"\n", ""}}));
  EXPECT_TRUE(
      ends_with(table.refusal(),
                "the shaft is not in equilibrium: the loads of \"belt\" leave torques about z that nothing "
                "balances; name the port that takes torque, torque_support in [shaft], or remove \"belt\""))
      << table.refusal();
}

// Forces of the scene are told with their ports; what a body's mass brings says where it is to be seen.
TEST(EffectsOfBodies, AreListedWithWhatTheSceneTells) {
  const auto effects = effects_of_bodies(plain::scene("root_peeler_shaft"));
  ASSERT_EQ(effects.size(), 4u);
  EXPECT_TRUE(of(effects, "shaft_inertia").forces.empty());
  EXPECT_EQ(of(effects, "belt_pull").forces, Names{"240 N across, at rest, on pulley_seat"});
  EXPECT_EQ(of(effects, "disc_imbalance").forces,
            Names{"860 N across, turning with the shaft, on disc_seat"});
  EXPECT_EQ(of(effects, "disc_weight").forces, Names{"-118 N along the shaft, on disc_seat"});
  EXPECT_EQ(of(effects, "disc_weight").shares.at(0).load, "shaft/disc_seat.fz");
  std::ostringstream out;
  print_effects_of_bodies(out, plain::scene("vibratory_mill"), false);
  EXPECT_NE(out.str().find("gravity_shaft on the shaft"), std::string::npos);
  EXPECT_NE(out.str().find("`millstress check vibratory_mill.toml -v` shows it"), std::string::npos)
      << out.str();
}

// 300 and 400 N at rest and at right angles, 500 N turning, on one port: they add up to 500 + 500 N at most,
// and to sqrt(500^2 + 500^2) N in the mean of squares.
TEST(EffectsOfBodies, ForcesOnOnePortShareIt) {
  Scene scene = plain::scene("root_peeler_shaft");
  std::get<pipelines::TrainShaftOptions>(scene.bodies[0].options).forces = {
      {"belt_pull", "disc_seat", {300, 0, 0}, false},
      {"belt_pull", "disc_seat", {0, 400, 0}, false},
      {"disc_imbalance", "disc_seat", {500, 0, 10}, true},
      {"disc_weight", "disc_seat", {0, 0, -40}, false}};
  const auto effects = effects_of_bodies(scene);
  const auto& pull = of(effects, "belt_pull").shares;
  ASSERT_EQ(pull.size(), 1u);
  EXPECT_NEAR(pull[0].largest, 0.5, 1e-15);
  EXPECT_NEAR(pull[0].rms, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(of(effects, "disc_weight").shares.at(0).largest, 40.0 / 30, 1e-15);
}
