#include "tests/cases/program.h"
#include "tests/cases/stepped_shaft.h"

using namespace cases;

namespace {

const nlohmann::json& shaft_of(const nlohmann::json& summary) {
  return summary["bodies"]["shaft"];
}

double peak_MPa(const nlohmann::json& summary) {
  return shaft_of(summary)["peak_von_mises"]["value"].get<double>() / 1e6;
}

}  // namespace

// A stricter tolerance walks the same way further: its first steps are those of the looser one. Each ends
// within its tolerance of the strictest, whose own error is a seventh.
TEST(Tolerance, EachIsMetAgainstTheStrictest) {
  const results_test::Directory directory;
  write(directory / "small.toml", stepped_shaft());
  std::map<std::string, nlohmann::json> results;
  for (const std::string percent : {"20", "3"}) {
    const auto run = millstress(
        directory.path, "run small.toml -o " + percent + " --threads 1 --tolerance '" + percent + " %'");
    ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
    results[percent] = summary(directory / percent);
    const auto& search = shaft_of(results[percent])["search"];
    EXPECT_TRUE(search["met"].get<bool>());
    const auto& error = shaft_of(results[percent])["peak_von_mises"]["error"];
    EXPECT_LE(error["numerical"].get<double>() / 1e6, std::stod(percent) / 100 * peak_MPa(results[percent]));
  }
  const double best_MPa = peak_MPa(results["3"]);
  for (const std::string percent : {"20"}) {
    EXPECT_NEAR(peak_MPa(results[percent]), best_MPa, std::stod(percent) / 100 * best_MPa) << percent;
    const auto& steps = shaft_of(results[percent])["search"]["steps"];
    const auto& all = shaft_of(results["3"])["search"]["steps"];
    ASSERT_LE(steps.size(), all.size());
    for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(steps[i], all[i]) << percent << ' ' << i;
  }
  EXPECT_GT(shaft_of(results["3"])["search"]["steps"].size(),
            shaft_of(results["20"])["search"]["steps"].size());
  // Only the fillets that may hold the peak became finer first.
  EXPECT_FALSE(fs::exists(directory / "3/shaft/search_1.h5"));
  EXPECT_TRUE(fs::exists(directory / "3/shaft/unit_responses.h5"));
}

// Time that is up keeps what there is: exit code 4, results whole, and a word on what the rest would cost.
TEST(Tolerance, NotMetInTimeKeepsTheResults) {
  const results_test::Directory directory;
  write(directory / "small.toml", stepped_shaft("tolerance = \"0.01 %\"\ntime_limit = \"3 s\""));
  const auto run = millstress(directory.path, "run small.toml -o out --threads 1");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(run.err.find("tolerance is not met"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("the next step needs about"), std::string::npos) << run.out;
  const auto json = summary(directory / "out");
  EXPECT_FALSE(shaft_of(json)["search"]["met"].get<bool>());
  EXPECT_TRUE(fs::exists(directory / "out/shaft/envelope.vtu"));
  EXPECT_TRUE(fs::exists(directory / "out/loads.h5"));
}

// The last mesh of a search is kept with its responses: the same run again solves that mesh no more.
TEST(Tolerance, SecondRunReusesTheLastMesh) {
  const results_test::Directory directory;
  write(directory / "small.toml", stepped_shaft("tolerance = \"20 %\""));
  ASSERT_EQ(millstress(directory.path, "run small.toml -o out --threads 1").exit_code, 0);
  const auto first = contents(directory / "out");
  const auto run = millstress(directory.path, "run small.toml -o out --threads 1");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("responses of an earlier run"), std::string::npos) << run.out;
  EXPECT_EQ(contents(directory / "out"), first);
}

TEST(Tolerance, WrongWishesAreRefused) {
  const results_test::Directory directory;
  write(directory / "small.toml", stepped_shaft());
  write(directory / "wrong.toml", stepped_shaft("tolerance = \"2 mm\""));
  for (const std::string arguments : {"run small.toml --tolerance soon", "run small.toml --tolerance '200 %'",
                                      "run small.toml --time-limit '3 kg'", "run wrong.toml"}) {
    const auto run = millstress(directory.path, arguments + " -o out");
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_NE(run.err.find(arguments == "run wrong.toml" ? "tolerance" : "--t"), std::string::npos)
        << run.err;
    EXPECT_FALSE(fs::exists(directory / "out")) << arguments;
  }
}
