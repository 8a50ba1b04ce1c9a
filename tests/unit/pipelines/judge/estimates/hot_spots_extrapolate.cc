/// Hot-spot stress of fields that can be written down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipelines/judge/estimates/hot_spots.h"

namespace {

constexpr double thickness = 0.006;

pipelines::Stress tension(double stress_Pa) {
  return {stress_Pa, 0, 0, 0, 0, 0};
}

/// A strip of two faces along a slanted line from the toe, stress (constant + slope x distance) of each
/// channel. The nearer point is a node in the middle of the first face, the farther one lies between nodes.
struct Line {
  std::array<double, 3> toe{0.1, -0.05, 0.02}, along{0.6, 0.0, 0.8};
  std::vector<pipelines::Stress> constant, slope;  // per channel
  fem::UnitResponses responses;

  std::array<double, 3> at(double distance) const {
    return {toe[0] + distance * along[0], toe[1] + distance * along[1], toe[2] + distance * along[2]};
  }
  Line(std::vector<pipelines::Stress> c, std::vector<pipelines::Stress> s)
      : constant(std::move(c)), slope(std::move(s)) {
    for (std::size_t k = 0; k < constant.size(); ++k) responses.channels.push_back("c" + std::to_string(k));
    auto& nodes = responses.nodes;
    for (const double share : {0.0, 0.4, 0.8, 1.2, 1.6})
      for (const double beside : {-0.3, 0.0, 0.3}) {
        const auto p = at(share * thickness);
        nodes.xyz_m.insert(nodes.xyz_m.end(), {p[0], p[1] + beside * thickness, p[2]});
        ++nodes.n;
        for (std::size_t k = 0; k < constant.size(); ++k)
          for (std::size_t i = 0; i < 6; ++i)
            responses.stress_Pa.push_back(constant[k][i] + slope[k][i] * share * thickness);
      }
    for (const std::int32_t first : {0, 6})  // corners, edges, centre
      for (const std::int32_t node : {0, 6, 8, 2, 3, 7, 5, 1, 4}) nodes.faces.push_back(first + node);
    nodes.face_boundary_id = {1, 1};
  }
  meshes::HotSpot spot(const std::string& name = "toe") const {
    return {name, thickness, toe, at(0.4 * thickness), at(thickness)};
  }
};

pipelines::ChannelHistory history(const Eigen::ArrayXXd& values) {
  pipelines::ChannelHistory loads;
  loads.values = values;
  return loads;
}

// A point that a vertex of the mesh has moved counts with its own distance: a linear field still ends at the
// toe.
TEST(HotSpots, OfPointsThatMovedAreExact) {
  const Line line({tension(100e6)}, {tension(-2e9)});
  auto moved = line.spot();
  moved.far_m = line.at(0.96 * thickness);
  const auto spots = hot_spot_stresses({moved}, line.responses, history(Eigen::ArrayXXd::Ones(1, 1)));
  ASSERT_EQ(spots.size(), 1u);
  EXPECT_NEAR(spots[0].von_mises_Pa, 100e6, 1e-9 * 100e6);
}

// Of a tube with plates, the cheapest model of a chamber, the points are all there is.
TEST(HotSpots, OfAModelWithoutFacesAreAtItsNodes) {
  const Line line({tension(100e6)}, {tension(-2e9)});
  fem::UnitResponses points;
  points.channels = {"c0"};
  for (const double share : {0.4, 1.0}) {
    const auto p = line.at(share * thickness);
    points.nodes.xyz_m.insert(points.nodes.xyz_m.end(), p.begin(), p.end());
    ++points.nodes.n;
    for (const double s : {100e6 - 2e9 * share * thickness, 0., 0., 0., 0., 0.})
      points.stress_Pa.push_back(s);
  }
  Eigen::ArrayXXd one(1, 1);
  one << 1;
  const auto own = hot_spot_stresses({line.spot()}, points, history(one)),
             meshed = hot_spot_stresses({line.spot()}, line.responses, history(one));
  ASSERT_EQ(own.size(), 1u);
  EXPECT_NEAR(own[0].von_mises_Pa, meshed[0].von_mises_Pa, 1e-9 * meshed[0].von_mises_Pa);
  EXPECT_EQ(own[0].near_node, 0u);
}

// Constant fields exactly; linear ones but for the rounding of the weights: 1.67 x 0.4 - 0.67 x 1.0 = -0.002
// thicknesses of the slope.
TEST(HotSpots, LinearFieldIsExtrapolatedToTheToe) {
  const pipelines::Stress constant{100e6, 20e6, -30e6, 5e6, -8e6, 40e6},
      slope{-2e9, 1e9, 3e9, 0.5e9, 0, -4e9};
  const Line flat({constant}, {tension(0)}), sloped({constant}, {slope});
  Eigen::ArrayXXd one(1, 1);
  one << 1;
  const auto on_flat = hot_spot_stresses({flat.spot()}, flat.responses, history(one));
  ASSERT_EQ(on_flat.size(), 1u);
  EXPECT_NEAR(on_flat[0].von_mises_Pa, pipelines::von_mises_Pa(constant), 1e-14 * 100e6 * 10);
  pipelines::Stress wanted = constant;
  for (std::size_t i = 0; i < 6; ++i) wanted[i] -= 0.002 * thickness * slope[i];
  const auto on_sloped = hot_spot_stresses({sloped.spot()}, sloped.responses, history(one));
  EXPECT_NEAR(on_sloped[0].von_mises_Pa, pipelines::von_mises_Pa(wanted), 1e-13 * 100e6);
  EXPECT_NEAR(on_sloped[0].von_mises_Pa, pipelines::von_mises_Pa(constant), 0.002 * thickness * 15e9);
  EXPECT_EQ(on_sloped[0].toe_m, sloped.toe);
  EXPECT_EQ(on_sloped[0].name, "toe");
  double sum = 0;
  for (const auto& part : on_sloped[0].parts) sum += part.weight;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(on_sloped[0].near_node, 4u) << "the middle of the first face";
}

// Across the toe is the direction from it to its points: n . s n with n = (0.6, 0, 0.8).
TEST(HotSpots, RangeIsOfTheStressAcrossTheToe) {
  const pipelines::Stress a{100e6, 7e6, 50e6, 3e6, 2e6, -20e6}, b{-10e6, 0, 30e6, 0, 0, 60e6};
  const Line line({a, b}, {tension(0), tension(0)});
  Eigen::ArrayXXd values(2, 3);
  values << 1, -1, 0.5, 0, 2, 3;
  const auto result = hot_spot_stresses({line.spot()}, line.responses, history(values));
  const auto across = [](const pipelines::Stress& s) { return 0.36 * s[0] + 0.64 * s[2] + 0.96 * s[5]; };
  std::array<double, 3> normal{}, mises{};
  for (Eigen::Index i = 0; i < 3; ++i) {
    pipelines::Stress s{};
    for (std::size_t c = 0; c < 6; ++c) s[c] = values(0, i) * a[c] + values(1, i) * b[c];
    normal[std::size_t(i)] = across(s);
    mises[std::size_t(i)] = pipelines::von_mises_Pa(s);
  }
  EXPECT_NEAR(result[0].max_normal_Pa, *std::max_element(normal.begin(), normal.end()), 1);
  EXPECT_NEAR(result[0].min_normal_Pa, *std::min_element(normal.begin(), normal.end()), 1);
  const auto worst = std::max_element(mises.begin(), mises.end());
  EXPECT_NEAR(result[0].von_mises_Pa, *worst, 1);
  EXPECT_EQ(result[0].instant, worst - mises.begin());
}

TEST(HotSpots, AreRankedByTheirStress) {
  const Line line({tension(1e6)}, {tension(1e9)});
  Eigen::ArrayXXd one(1, 1);
  one << 1;
  // Farther along the same line the stress is larger: points at 0.7 and 0.4 thicknesses, between nodes.
  auto other = line.spot("farther");
  other.near_m = line.at(0.7 * thickness);
  other.far_m = line.at(0.4 * thickness);
  const auto result = hot_spot_stresses({line.spot(), other}, line.responses, history(one));
  ASSERT_EQ(result.size(), 2u);
  EXPECT_EQ(result[0].name, "farther");
  EXPECT_GT(result[0].von_mises_Pa, result[1].von_mises_Pa);
}

// The strip's first face ends at 0.8 thicknesses.
TEST(HotSpots, KnowTheFaceBetweenToeAndPoint) {
  const Line line({tension(1e6)}, {tension(0)});
  Eigen::ArrayXXd one(1, 1);
  one << 1;
  auto beyond = line.spot("beyond");
  beyond.near_m = line.at(thickness);  // in the second face
  beyond.far_m = line.at(1.2 * thickness);
  for (const auto& spot : hot_spot_stresses({line.spot(), beyond}, line.responses, history(one)))
    EXPECT_NEAR(spot.face_walls, spot.name == "toe" ? 0.8 : 0, 1e-12) << spot.name;
}

TEST(HotSpots, PointOffTheSurfaceIsRefused) {
  const Line line({tension(1e6)}, {tension(0)});
  Eigen::ArrayXXd one(1, 1);
  one << 1;
  auto spot = line.spot("web_1 edge 1");
  spot.far_m[0] -= 0.8 * 0.05 * thickness;  // across the strip
  spot.far_m[2] += 0.6 * 0.05 * thickness;
  try {
    hot_spot_stresses({spot}, line.responses, history(one));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("web_1 edge 1"), std::string::npos);
  }
}

}  // namespace
