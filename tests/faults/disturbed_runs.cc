#include "tests/faults/disturbed_runs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace faults {

long asked_for(long by_default, long all) {
  const char* text = std::getenv("MILLSTRESS_FAULTS");
  if (text == nullptr) return std::min(by_default, all);
  const long asked = std::atol(text);
  return asked <= 0 ? all : std::min(asked, all);
}

std::string short_bar(int pull_kN) {
  const auto segment = [](const std::string& what, int length_mm) {
    return "  { " + what + ", diameter = \"10 mm\", length = \"" + std::to_string(length_mm) + " mm\" },\n";
  };
  return "title = \"Short bar\"\neffects = [\"pull\"]\n[machine]\ntype = \"load_table\"\nspeed = \"600 "
         "rpm\"\n"
         "[[machine.constants]]\neffect = \"pull\"\nload = \"middle.fy\"\nvalue = \"" +
         std::to_string(pull_kN) +
         " kN\"\n[sampling]\ninstants_per_turn = 24\nturns = 1\n[shaft]\ncontour = [\n" +
         segment("port = \"bearing_1\"", 4) + segment("name = \"left\"", 20 + pull_kN) +
         segment("port = \"middle\"", 20) + segment("name = \"right\"", 28) +
         segment("port = \"bearing_2\"", 4) +
         "]\nbearings = [\"bearing_1\", \"bearing_2\"]\ntorque_support = \"bearing_2\"\n[shaft.material]\n"
         "name = \"steel\"\nyoungs_modulus = \"206 GPa\"\npoisson_ratio = 0.3\ndensity = \"7850 kg/m3\"\n"
         "yield_strength = \"305 MPa\"\n[shaft.mesh]\nsectors = 8\nlargest_cell = \"20 mm\"\n[results]\n"
         "snapshots = 1\npictures = false\n";
}

namespace {

/// Names of two sets of files that differ, for the message of a test.
std::string difference(const Files& found, const Files& wanted) {
  std::string names;
  for (const auto& [name, bytes] : found) {
    const auto same = wanted.find(name);
    if (same == wanted.end())
      names += " +" + name;
    else if (same->second != bytes)
      names += " " + name;
  }
  for (const auto& [name, bytes] : wanted)
    if (found.count(name) == 0) names += " -" + name;
  return names;
}

double stress_Pa(const Files& results) {
  return nlohmann::json::parse(results.at("summary.json"))["bodies"]["shaft"]["governing"]["value"];
}

}  // namespace

Files results_in(const fs::path& directory) {
  return cases::contents(directory);
}

void DisturbedRuns::prepare(const std::string& model) {
  arguments_ = "run next.toml --method " + model + " --tolerance none --force -q -o ";
  cases::write(directory_ / "earlier.toml", short_bar(1));
  cases::write(directory_ / "next.toml", short_bar(2));
  const auto first = "run earlier.toml --method " + model + " --tolerance none --force -q -o ";
  ASSERT_EQ(run(first + "earlier").exit_code, 0);
  restore();
  ASSERT_EQ(run(arguments_ + "out").exit_code, 0);
  next_ = results_in(directory_ / "out");
  restore();
  earlier_ = results_in(directory_ / "out");
  ASSERT_NE(earlier_, next_);
}

void DisturbedRuns::restore() const {
  fs::remove_all(directory_ / "out");
  fs::copy(directory_ / "earlier", directory_ / "out", fs::copy_options::recursive);
}

cases::Outcome DisturbedRuns::run(const std::string& arguments, const std::string& before) const {
  if (launcher_.empty()) return cases::as_a_user(directory_.path, arguments, before);
  const cases::Start start{directory_.path, arguments, before, launcher_, ""};
  return cases::outcome_of(start, std::system(cases::shell_command(start).c_str()));
}

cases::Outcome DisturbedRuns::run_next(const std::string& before) const {
  return run(arguments_ + "out", before);
}

std::string DisturbedRuns::failing(const std::string& kind, long at) const {
  return "export LD_PRELOAD='" FAILING_DISK "' FAULTS_BELOW='" + (directory_ / below_).string() +
         "' FAULTS_KIND=" + kind + " FAULTS_AT=" + std::to_string(at);
}

std::string DisturbedRuns::operations() const {
  restore();
  const auto count = directory_ / "operations";
  const auto outcome = run_next(failing("count", 0) + " FAULTS_COUNT='" + count.string() + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::ifstream in(count, std::ios::binary);
  const std::string letters{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  fs::remove(count);
  return letters;
}

bool DisturbedRuns::same(const Files& found, const Files& wanted) const {
  if (bits_repeat_) return found == wanted;
  const auto same_name = [](const auto& a, const auto& b) { return a.first == b.first; };
  return std::equal(found.begin(), found.end(), wanted.begin(), wanted.end(), same_name) &&
         std::abs(stress_Pa(found) / stress_Pa(wanted) - 1) < 1e-9;
}

bool DisturbedRuns::expect_nothing_lost(const std::string& what) const {
  const auto report = cases::millstress(directory_.path, "report out");
  EXPECT_EQ(report.exit_code, 0) << what << ": " << report.err;
  // Hidden folders of a killed run wait for the next one; what they are called is not a result's name.
  Files found;
  for (auto& [name, bytes] : results_in(directory_ / "out"))
    if (name[0] != '.' && name.find("/.") == std::string::npos) found.emplace(name, std::move(bytes));
  const bool there = same(found, next_);
  EXPECT_TRUE(there || same(found, earlier_))
      << what << ": neither the earlier results:" << difference(found, earlier_)
      << "\nnor the next ones:" << difference(found, next_);
  const auto again = run_next();
  EXPECT_EQ(again.exit_code, 0) << what << ": " << again.err;
  EXPECT_EQ(again.err, "") << what;
  const auto all = cases::contents(directory_ / "out");
  EXPECT_TRUE(same(all, next_)) << what << ": the next run:" << difference(all, next_);
  for (const auto& entry : fs::recursive_directory_iterator(directory_ / "out"))
    EXPECT_NE(entry.path().filename().string()[0], '.') << what << ": left behind " << entry.path();
  return there;
}

}  // namespace faults
