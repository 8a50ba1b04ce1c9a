/// The largest stress of every place under many load cases, beside walks over all nodes.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/search/loop/scene_run.h"
#include "pipelines/study/variations/leading_stress.h"
#include "pipelines/superpose/envelope/zones.h"
#include "tests/unit/pipelines/examples/results_directory.h"
#include "tests/unit/pipelines/examples/shared_environment.h"

using namespace pipelines;

namespace {

const char* const stepped_bar = R"(
effects = ["across", "turning", "twist"]
tolerance = "none"
[machine]
type = "load_table"
speed = "600 rpm"
[[machine.constants]]
effect = "across"
load = "middle.fy"
value = "1 kN"
[[machine.harmonics]]
effect = "turning"
load = "middle.fx"
order = 1
amplitude = "700 N"
[[machine.constants]]
effect = "twist"
load = "middle.torque"
value = "9 N m"
[sampling]
instants_per_turn = 32
turns = 1
[shaft]
contour = [
  { port = "bearing_1", diameter = "20 mm", length = "14 mm" },
  { fillet = "1.5 mm" },
  { port = "middle", diameter = "26 mm", length = "30 mm" },
  { fillet = "2 mm" },
  { port = "bearing_2", diameter = "19 mm", length = "14 mm" },
]
bearings = ["bearing_1", "bearing_2"]
torque_support = "bearing_2"
[shaft.material]
name = "steel"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
[shaft.mesh]
cells_per_fillet_quarter = 2
sectors = 8
)";

/// At half of the peak and at nine tenths.
void expect_same_zones(const Judged& analysis, const LeadingStress& leading, const ChannelHistory& loads,
                       const Envelope& whole, const Envelope& some) {
  const auto& nodes = analysis.responses.nodes;
  const double peak_Pa = whole.von_mises.value_Pa[peak_node(whole.von_mises.value_Pa, analysis.places)];
  for (const double share : {0.5, 0.9}) {
    auto completed = some;
    leading.complete_above(share * peak_Pa, loads, analysis.responses, completed);
    const auto wanted = find_zones(nodes, whole.von_mises, analysis.places, share * peak_Pa, 1.0),
               found = find_zones(nodes, completed.von_mises, analysis.places, share * peak_Pa, 1.0);
    EXPECT_EQ(found.zone_of_node, wanted.zone_of_node);
    ASSERT_EQ(found.zones.size(), wanted.zones.size());
    ASSERT_FALSE(found.zones.empty());
    for (std::size_t z = 0; z < wanted.zones.size(); ++z) {
      EXPECT_EQ(found.zones[z].peak_Pa, wanted.zones[z].peak_Pa);
      EXPECT_EQ(found.zones[z].instant, wanted.zones[z].instant);
      EXPECT_EQ(found.zones[z].volume_m3, wanted.zones[z].volume_m3);
    }
  }
}

}  // namespace

// Load cases like the known one, scaled, with noise, of other instants and of any direction: of each place
// the same node, stress and instant as in an envelope of all nodes, bit for bit; and the same zones.
TEST(LeadingStress, IsThatOfAWholeEnvelope) {
  shared::start_fem();
  const results_test::Directory directory;
  std::ofstream(directory / "bar.toml") << stepped_bar;
  StageClock clock;
  SceneRunOptions options;
  options.cache = false;
  options.n_threads = 1;
  options.accuracy.once = true;
  const auto run = run_scene(read_scene(directory / "bar.toml"), options, clock);
  const auto& analysis = run.analyses.front();
  const LeadingStress leading(analysis);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto noise = [&](Eigen::Index rows, Eigen::Index cols) {
    return Eigen::ArrayXXd::NullaryExpr(rows, cols, [&] { return normal(random); });
  };
  for (int i = 0; i < 60; ++i) {
    ChannelHistory loads = analysis.loads.history;
    const Eigen::ArrayXd sizes = loads.values.abs().rowwise().maxCoeff();
    const Eigen::Index n_instants = i % 5 == 4 ? 7 : loads.values.cols();
    const double size = std::pow(10, 0.5 * normal(random)), spread = i % 3 == 0 ? 0.02 : i % 3 == 1 ? 0.5 : 3;
    Eigen::ArrayXXd values = n_instants == loads.values.cols()
                                 ? Eigen::ArrayXXd(size * loads.values)
                                 : Eigen::ArrayXXd(Eigen::ArrayXXd::Zero(loads.values.rows(), n_instants));
    values += spread * (noise(values.rows(), values.cols()).colwise() * sizes);
    loads.values = values;
    loads.by_effect = {values, Eigen::ArrayXXd::Zero(values.rows(), values.cols()),
                       Eigen::ArrayXXd::Zero(values.rows(), values.cols())};
    const auto places_of = [&](const Envelope& e) {
      return largest_by_feature(analysis.responses.nodes, e.von_mises.value_Pa, analysis.mesh.features,
                                analysis.places);
    };
    const auto whole = envelope(loads, analysis.responses, 1),
               some = leading.envelope(loads, analysis.responses);
    if (i % 4 == 0) expect_same_zones(analysis, leading, loads, whole, some);
    const auto wanted = places_of(whole), found = places_of(some);
    ASSERT_EQ(found.size(), wanted.size()) << i;
    for (std::size_t p = 0; p < wanted.size(); ++p) {
      EXPECT_EQ(found[p].feature, wanted[p].feature) << i;
      EXPECT_EQ(found[p].value_Pa, wanted[p].value_Pa) << i << ' ' << wanted[p].feature;
      EXPECT_EQ(some.von_mises.instant[found[p].node], whole.von_mises.instant[wanted[p].node]);
    }
  }
}
