/// Scenes drawn at random from the shipped ones, valid and broken: each is refused with a reason, or its
/// loads are finite. MILLSTRESS_MUTATIONS says how many per scene (default 400); the same seed every time.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "pipelines/scene/scene.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace {

namespace fs = std::filesystem;
using Random = std::mt19937;

std::size_t below(Random& random, std::size_t n) {
  return std::size_t(random()) % n;
}

/// Scales one number of the text by up to a factor of 1e3 either way, turns its sign, or makes it zero: most
/// of these scenes stay valid.
void change_number(std::string& text, Random& random) {
  std::vector<std::pair<std::size_t, std::size_t>> numbers;  // begin, length
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '#') comment = true;
    if (text[i] == '\n') comment = false;
    const bool begins = std::isdigit(static_cast<unsigned char>(text[i])) &&
                        (i == 0 || std::string(" \"[-=").find(text[i - 1]) != std::string::npos);
    if (comment || !begins) continue;
    std::size_t end = i;
    while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) || text[end] == '.'))
      ++end;
    numbers.emplace_back(i, end - i);
    i = end;
  }
  if (numbers.empty()) return;
  const auto [begin, length] = numbers[below(random, numbers.size())];
  const double value = std::strtod(text.c_str() + begin, nullptr);
  const double factor = std::pow(10.0, std::uniform_real_distribution<double>(-3, 3)(random));
  const double changed[] = {value * factor, value * factor, value * 1.1, 0.0, -value};
  char number[40];
  std::snprintf(number, sizeof number, "%.6g", changed[below(random, 5)]);
  text.replace(begin, length, number);
}

/// Takes lines out, doubles or swaps them, or puts a foreign character in.
void break_text(std::string& text, Random& random) {
  static const std::vector<std::string> pieces = {"\"", "[", "]", "=",   "nan", "{",
                                                  ",",  "#", "0", "inf", "[[",  "-"};
  std::vector<std::string> lines;
  std::string line;
  for (const char c : text + "\n") {
    line += c;
    if (c == '\n') lines.push_back(std::exchange(line, ""));
  }
  const std::size_t at = below(random, lines.size());
  switch (below(random, 4)) {
    case 0:
      lines.erase(lines.begin() + std::ptrdiff_t(at));
      break;
    case 1:
      lines.insert(lines.begin() + std::ptrdiff_t(at), std::string(lines[at]));
      break;
    case 2:
      std::swap(lines[at], lines[below(random, lines.size())]);
      break;
    default:
      lines[at].insert(below(random, lines[at].size()), pieces[below(random, pieces.size())]);
  }
  text.clear();
  for (const auto& l : lines) text += l;
}

/// Few instants, but the whole period where a table needs it.
kinetics::TimeGrid small(const pipelines::Scene& scene) {
  const bool is_table = std::holds_alternative<kinetics::LoadTable>(scene.machine);
  return {is_table ? scene.sampling.turns : std::min(scene.sampling.turns, 3), 16};
}

void expect_finite(const kinetics::LoadHistory& loads, const std::string& scene) {
  for (const auto& quantity : loads.quantities)
    if (quantity.has_statistics) {
      EXPECT_TRUE(quantity.values.isFinite().all()) << quantity.name << " of\n" << scene;
    }
  for (const auto& resultant : loads.resultants) {
    EXPECT_TRUE(resultant.total.isFinite().all()) << resultant.role << " of\n" << scene;
    for (const auto& part : resultant.contributions)
      EXPECT_TRUE(part.load.isFinite().all()) << part.effect << " in " << resultant.role << " of\n" << scene;
  }
}

int n_mutations() {
  const char* text = std::getenv("MILLSTRESS_MUTATIONS");
  return text ? std::atoi(text) : 400;
}

}  // namespace

class MutatedScene : public testing::TestWithParam<std::string> {};

TEST_P(MutatedScene, IsRefusedOrHasFiniteLoads) {
  const results_test::Directory directory;
  const fs::path scenes = fs::path(SOURCE_DIR) / "pipelines/scenes";
  fs::copy(scenes / "belt_pull.csv", directory / "belt_pull.csv");
  std::string original = results_test::bytes(scenes / GetParam());
  // Without bodies: this is about loads.
  original = original.substr(0, original.find("# Without [shaft]"));
  const auto own_mass = original.find("  \"gravity_shaft\"");
  if (own_mass != std::string::npos) original.insert(own_mass, "#");
  const fs::path file = directory / "scene.toml";
  Random random(20261121);
  int n_computed = 0, n_refused = 0;
  for (int i = 0; i < n_mutations(); ++i) {
    std::string text = original;
    for (std::size_t m = 0, n = 1 + below(random, 4); m < n; ++m)
      below(random, 5) == 0 ? break_text(text, random) : change_number(text, random);
    std::ofstream(file, std::ios::binary) << text;
    try {
      const auto scene = pipelines::read_scene(file);
      expect_finite(pipelines::compute_loads(scene.machine, scene.kinetics_effects(), small(scene)), text);
      ++n_computed;
    } catch (const pipelines::SceneError& refused) {
      EXPECT_FALSE(refused.findings().empty());
      ++n_refused;
    } catch (const std::invalid_argument& refused) {
      EXPECT_NE(std::string(refused.what()), "");
      ++n_refused;
    } catch (const std::exception& other) {
      ADD_FAILURE() << other.what() << "\n" << text;
    }
    if (HasFailure()) return;
  }
  // The draw must do both, or it tests nothing.
  EXPECT_GT(n_computed, n_mutations() / 10);
  EXPECT_GT(n_refused, n_mutations() / 20);
}

INSTANTIATE_TEST_SUITE_P(shipped, MutatedScene,
                         testing::Values("vibratory_mill.toml", "planetary_mill.toml", "drive_train.toml",
                                         "load_table.toml", "stub_axle.toml", "root_peeler_shaft.toml"),
                         [](const auto& test) { return test.param.substr(0, test.param.find('.')); });
