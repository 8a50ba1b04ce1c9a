/// Lives of rolling bearings, as the load stage and a run state them.
#include <cmath>

#include "tests/cases/program/program.h"

using namespace cases;

// L10h from the equivalent load of the series that the program wrote: P = (mean F^p)^(1/p), L = (C/P)^p.
TEST(LoadStage, BearingsGetALife) {
  const results_test::Directory directory;
  // The last two tables need a [shaft].
  std::string text = edited("vibratory_mill.toml", {{"  \"gravity_shaft\", \"shaft_inertia\",", "  #"}});
  text = text.substr(0, text.find("# Without [shaft]")) +
         "[[bearings]]\nname = \"frame\"\nload = \"R_E\"\nshare = \"50 %\"\ndynamic_rating = \"40 kN\"\n"
         "element = \"roller\"\n";
  write(directory / "mill.toml", text);
  const auto json = json_of(directory.path, "loads mill.toml --csv loads.csv --json")["bearings"]["frame"];
  const double p = 10.0 / 3;
  double mean = 0;
  const auto reaction = csv(directory / "loads.csv").at("R_E");
  for (const double R : reaction) mean += std::pow(R / 2, p) / double(reaction.size());
  const double P = std::pow(mean, 1 / p);
  EXPECT_NEAR(json["equivalent_load"]["value"].get<double>(), P, 1e-10 * P);
  const double L10 = 1e6 * std::pow(40e3 / P, p);
  EXPECT_NEAR(json["L10"].get<double>(), L10, 1e-9 * L10);
  EXPECT_NEAR(json["L10h"]["value"].get<double>(), L10 / (151.844 / (2 * M_PI)) / 3600, 1e-9 * L10);

  write(directory / "mill.toml", std::string(text).replace(text.rfind("\"R_E\""), 5, "\"R_F\""));
  const auto wrong = millstress(directory.path, "loads mill.toml");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("\"R_F\""), std::string::npos) << wrong.err;
  EXPECT_NE(wrong.err.find("frame_bearings"), std::string::npos) << wrong.err;
}

// The turns of a start count, not its instants. Red if the mean is over these: P 17 % too small, a life 1.7
// times too long.
TEST(LoadStage, BearingsLoadedBeyondTheLawOfTheirLifeAreWarnedOf) {
  const results_test::Directory directory;
  // 2278 N of equivalent load: 4 kN would last 62 hours, and 30 N, with the unit forgotten, 0.09 seconds.
  for (const auto& [rating, is_beyond] : {std::pair{"4600", false}, {"4500", true}, {"30", true}}) {
    const auto outcome = millstress(directory.path, "loads '" + shipped("vibratory_mill.toml").string() +
                                                        "' --set bearings[1].dynamic_rating=" + rating);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("is more than half of its dynamic rating") != std::string::npos, is_beyond)
        << rating;
  }
}

TEST(LoadStage, BearingsOfARunUpAreLoadedByTheTurn) {
  const results_test::Directory directory;
  std::string text = edited("vibratory_mill.toml", {{"  \"gravity_shaft\", \"shaft_inertia\",", "  #"}});
  write(directory / "mill.toml", text.substr(0, text.find("# Without [shaft]")) +
                                     "[[bearings]]\nname = \"frame\"\nload = \"R_E\"\ndynamic_rating = "
                                     "\"40 kN\"\nelement = \"ball\"\n[machine.run_up]\nfrom = 0\nto = "
                                     "\"1450 rpm\"\nduration = \"2 s\"\nhold = \"0.1 s\"\n");
  const auto json = json_of(directory.path, "loads mill.toml --csv loads.csv --json")["bearings"]["frame"];
  const auto loads = csv(directory / "loads.csv");
  const auto &speed = loads.at("speed"), &time = loads.at("time"), &reaction = loads.at("R_E");
  double turns = 0, sum = 0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double step = (speed[i - 1] + speed[i]) / 2 * (time[i] - time[i - 1]);
    turns += step;
    sum += step * (std::pow(reaction[i - 1], 3) + std::pow(reaction[i], 3)) / 2;
  }
  const double P = std::cbrt(sum / turns);
  EXPECT_NEAR(json["equivalent_load"]["value"].get<double>(), P, 1e-9 * P) << "round-off of the angles";
}

// The answers beyond L10 follow from the figures beside them: a1 = 0.95 (ln 0.95 / ln 0.9)^(2/3) + 0.05, the
// rating that a life needs by ISO 281, and by Shigley's law what is asked of it and what the bearing gives.
// What is not asked is not there. Round-off, and nothing else.
TEST(LoadStage, BearingsAnswerWhatTheSceneAsks) {
  const results_test::Directory directory;
  std::string text = edited("vibratory_mill.toml", {{"  \"gravity_shaft\", \"shaft_inertia\",", "  #"}});
  text =
      text.substr(0, text.find("# Without [shaft]")) +
      "[[bearings]]\nname = \"frame\"\nload = \"R_E\"\nshare = \"50 %\"\ndynamic_rating = \"40 kN\"\n"
      "element = \"ball\"\nreliability = \"95 %\"\nrequired_life = \"30000 h\"\nstatic_rating = \"20 kN\"\n"
      "viscosity_ratio = 1\ncontamination_factor = \"50 %\"\nfatigue_load_limit = \"900 N\"\n";
  write(directory / "mill.toml", text);
  const auto all = json_of(directory.path, "loads mill.toml --json")["bearings"];
  EXPECT_FALSE(all["main bearings"].contains("reliability"));
  EXPECT_FALSE(all["main bearings"].contains("static_safety"));
  const auto& frame = all["frame"];
  const auto value = [&](const char* key) { return frame[key]["value"].get<double>(); };
  const double P = value("equivalent_load"), a1 = frame["a1"], a_iso = frame["a_ISO"];
  EXPECT_NEAR(a1, 0.95 * std::pow(std::log(0.95) / std::log(0.9), 2.0 / 3) + 0.05, 1e-12);
  EXPECT_NEAR(a_iso, 0.1 * std::pow(1 - std::pow(0.5684, 0.83) * std::cbrt(450 / P), -9.3), 1e-9 * a_iso);
  EXPECT_NEAR(value("modified_life"), a1 * a_iso * value("L10h"), 1e-9 * value("L10h"));
  const double millions = 30000 * 3600 * 151.844 / (2 * M_PI) / 1e6;
  EXPECT_NEAR(value("required_rating"), P * std::cbrt(millions / (a1 * a_iso)), 1e-6 * P);
  const double reached = 0.02 + 4.439 * std::pow(-std::log(0.95), 1 / 1.483);
  EXPECT_NEAR(value("required_rating_weibull"), P * std::cbrt(millions / reached), 1e-6 * P);
  const double x = millions * std::pow(P / 40e3, 3);
  EXPECT_NEAR(frame["reliability_weibull"].get<double>(), std::exp(-std::pow((x - 0.02) / 4.439, 1.483)),
              1e-9);
  EXPECT_NEAR(frame["static_safety"].get<double>(), 20e3 / value("largest_load"), 1e-9);
  const auto printed = millstress(directory.path, "loads mill.toml");
  EXPECT_NE(printed.out.find("% of them reach"), std::string::npos) << printed.out;
  EXPECT_NE(printed.out.find("static safety"), std::string::npos) << printed.out;
}

// Under a torque alone no force reaches the bearings; the run was refused, "there is no force".
TEST(LoadStage, BearingsThatNothingLoadsHaveNoLife) {
  const results_test::Directory directory;
  write(directory / "shaft.toml", R"(
effects = "all"
[machine]
type = "load_table"
speed = "960 rpm"
harmonics = [{ effect = "drive", load = "b.torque", amplitude = 30 }]
[[bearings]]
name = "left"
load = "a"
dynamic_rating = "20 kN"
element = "ball"
[shaft]
contour = [
  { port = "a", diameter = "30 mm", length = "30 mm" },
  { fillet = "1 mm" },
  { port = "b", diameter = "36 mm", length = "60 mm" },
]
bearings = ["a", "b"]
torque_support = "a")" + steel_of("shaft") +
                                      "[results]\nsnapshots = 0\npictures = false\n");
  const auto run = as_a_user(directory.path, "run shaft.toml --method beam --tolerance none -o r");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("unloaded"), std::string::npos) << run.out;
  const auto left = summary(directory / "r")["bearings"]["left"];
  EXPECT_EQ(left["equivalent_load"]["value"], 0);
  EXPECT_TRUE(left["L10h"].is_null());
}
