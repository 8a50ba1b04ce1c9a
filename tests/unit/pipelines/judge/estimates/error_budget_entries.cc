#include "pipelines/judge/estimates/error_budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/search/refinement/refinement.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "tests/unit/pipelines/examples/results_bar.h"

using namespace pipelines;

namespace {

/// One node without cells, one channel per unit stress.
fem::UnitResponses at_one_node(const std::vector<std::array<double, 6>>& unit) {
  fem::UnitResponses responses;
  responses.nodes.n = 1;
  responses.nodes.xyz_m = {0, 0, 0};
  for (std::size_t k = 0; k < unit.size(); ++k) {
    responses.channels.push_back("port.c" + std::to_string(k));
    responses.stress_Pa.insert(responses.stress_Pa.end(), unit[k].begin(), unit[k].end());
  }
  return responses;
}

/// The cosine of a half-cosine's harmonic, with its coefficient; n = 1 is the force.
fem::UnitLoad pressure(int harmonic, int seat = 0) {
  const std::string port = "port" + std::to_string(seat);
  if (harmonic == 1) return {port + ".fx", fem::SurfaceResultant{}};
  fem::SeatPressure shape;
  shape.harmonic = harmonic;
  shape.coefficient = pattern_coefficient({}, harmonic);
  return {port + ".p" + std::to_string(harmonic), shape};
}

BodyLoads loads_of(const Eigen::ArrayXXd& values, std::vector<fem::UnitLoad> unit_loads = {}) {
  BodyLoads loads;
  loads.history.values = values;
  loads.unit_loads = std::move(unit_loads);
  return loads;
}

Eigen::Index largest(const Eigen::ArrayXXd& values) {
  Eigen::Index row, column;
  values.abs().maxCoeff(&row, &column);
  return column;
}

}  // namespace

// A cosine between its samples: 1 - cos(d) is missing, d the angle from the next sample to the crest. The
// parabola through three samples finds all but the fourth order, (d^2 + h^2)^2 / 24 with h = 15 degrees.
TEST(ErrorBudget, TimeSamplingFindsTheCrestBetweenInstants) {
  constexpr int n = 24;
  for (const double shift : {0.0, 0.05, 0.1, 0.13}) {
    Eigen::ArrayXXd values(1, n);
    for (int i = 0; i < n; ++i) values(0, i) = 2 + std::cos(2 * M_PI * i / n - shift);
    const auto budget = self_estimate({{{0, 1.0}}, std::int32_t(largest(values))},
                                      at_one_node({{1, 0, 0, 0, 0, 0}}), loads_of(values), {}, 0);
    EXPECT_NEAR(budget.of("time_sampling"), 1 - std::cos(shift), 3e-4) << shift;
  }
}

// The cycle closes: a crest just before the first instant is seen from there.
TEST(ErrorBudget, TimeSamplingTakesTheCycleAsPeriodic) {
  Eigen::ArrayXXd values(1, 24);
  for (int i = 0; i < 24; ++i) values(0, i) = 2 + std::cos(2 * M_PI * i / 24 + 0.1);
  const auto budget =
      self_estimate({{{0, 1.0}}, 0}, at_one_node({{1, 0, 0, 0, 0, 0}}), loads_of(values), {}, 0);
  EXPECT_NEAR(budget.of("time_sampling"), 1 - std::cos(0.1), 3e-4);
}

// A half-cosine's coefficients are 4 / (pi (n^2 - 1)) of even n, with changing signs: those above N add up to
// 2 / (pi (N + 1)). Where stress per coefficient does not fall with n, here 1 Pa at 10 N, that is left out;
// where it falls like a ring's, 1 Pa / (n^2 - 1), the sum of their squares is.
TEST(ErrorBudget, PressureHarmonicsAreWhatTheSeriesGoesOnWith) {
  const auto of = [](int highest, bool is_ring) {
    std::vector<fem::UnitLoad> loads{pressure(1)};
    std::vector<std::array<double, 6>> unit{{1, 0, 0, 0, 0, 0}};
    for (int n = 0; n <= highest; n += 2) {
      loads.push_back(pressure(n));
      unit.push_back(
          {0.1 * pattern_coefficient({}, n) / (is_ring && n > 0 ? n * n - 1.0 : 1), 0, 0, 0, 0, 0});
    }
    auto all = loads_of(Eigen::ArrayXXd::Constant(Eigen::Index(loads.size()), 3, 10), loads);
    all.pressures["port0"].highest_harmonic = highest;
    return self_estimate({{{0, 1.0}}, 1}, at_one_node(unit), all, {}, 0).of("pressure_harmonics");
  };
  for (const int highest : {4, 6, 12}) {
    EXPECT_NEAR(of(highest, false), 2 / (M_PI * (highest + 1)), 0.02 / highest) << highest;
    double of_ring = 0;
    for (int n = highest + 2; n < 4000; n += 2) of_ring += 4 / (M_PI * (n * n - 1.0) * (n * n - 1.0));
    EXPECT_NEAR(of(highest, true), of_ring, 1e-3 * of_ring) << highest;
  }
}

// Seats have patterns of their own: a point feels those of one seat, with its own highest harmonic, and the
// force of the other one brings nothing. A point without pressures has nothing to lack.
TEST(ErrorBudget, PressureHarmonicsAreThoseOfEachSeat) {
  const auto unit = [](int n) {
    return std::array<double, 6>{0.1 * pattern_coefficient({}, n), 0, 0, 0, 0, 0};
  };
  const std::array<double, 6> none{};
  auto loads = loads_of(Eigen::ArrayXXd::Constant(5, 3, 10),
                        {pressure(0, 1), pressure(2, 1), pressure(0, 2), pressure(2, 2), pressure(4, 2)});
  loads.pressures["port1"].highest_harmonic = 2;
  const auto responses = at_one_node({unit(0), unit(2), none, none, none});
  const auto entry = [&] {
    return self_estimate({{{0, 1.0}}, 1}, responses, loads, {}, 0).of("pressure_harmonics");
  };
  loads.pressures["port2"].highest_harmonic = 4;
  EXPECT_NEAR(entry(), 2 / (M_PI * 3), 0.01);
  loads.history.values.topRows(2).setZero();
  EXPECT_EQ(entry(), 0);
}

// Three radii's worth of relative error: sigma = M r / I ~ r^-3. Without curved faces around it is the
// body's worst.
TEST(ErrorBudget, GeometryGoesWithTheThirdPowerOfTheRadius) {
  const Eigen::ArrayXXd values = Eigen::ArrayXXd::Constant(1, 3, 5.0);
  const auto responses = at_one_node({{1, 0, 0, 0, 0, 0}});
  const StressPoint point{{{0, 1.0}}, 0};
  fem::GeometryError error;
  error.relative = 1e-3;
  const auto budget =
      self_estimate(point, responses, loads_of(values), {}, geometry_share(error, responses.nodes, point));
  const double r = 1, off = 1 + 1e-3;
  EXPECT_NEAR(budget.of("geometry"), 5 * (1 - std::pow(r / off, 3)), 0.01 * budget.of("geometry"));
  EXPECT_EQ(budget.largest(), "geometry");
  EXPECT_EQ(budget.of("discretisation"), 0);  // no cells, no such estimate
}

// A coarse fillet far away does not make the peak at another one worse: only surfaces that meet at the point
// count. A notch's stress goes with the square root of its radius, bending with the third power of the
// shaft's.
TEST(ErrorBudget, GeometryIsThatOfTheSurfacesAround) {
  fem::Nodes nodes;
  nodes.n = 25;
  for (int face = 0; face < 2; ++face)
    for (int i = 0; i < 9; ++i) nodes.faces.push_back(8 * face + i);  // node 8 is in both
  nodes.face_boundary_id = {1, 2};
  fem::GeometryError error;
  error.relative = 0.1;
  error.surfaces[1] = {1e-3, 4e-3};
  error.surfaces[2] = {2e-3, 0};
  const auto at = [&](std::size_t node) { return geometry_share(error, nodes, {{{node, 1.0}}, 0}); };
  const double thinner = 1 - 1e-3, sharper = 1 - 4e-3;
  EXPECT_NEAR(at(0), std::pow(thinner, -3) * std::pow(sharper, -0.5) - 1, 0.01 * at(0));
  EXPECT_NEAR(at(12), 6e-3, 1e-15);
  EXPECT_NEAR(at(8), 6e-3, 1e-15);
  EXPECT_NEAR(at(20), 0.3, 1e-15);
}

// Weights of an extrapolation act on the tensors, before von Mises.
TEST(ErrorBudget, ExtrapolatedStressIsTheWeightedSumOfTensors) {
  auto responses = at_one_node({{3, 1, 0, 2, 0, 0}});
  responses.nodes.n = 2;
  responses.stress_Pa.insert(responses.stress_Pa.end(), {1, -2, 4, 0, 1, 0});
  const auto unit = unit_stress_at(responses, {{{0, 1.67}, {1, -0.67}}, 0});
  const Stress wanted{1.67 * 3 - 0.67, 1.67 + 2 * 0.67, -4 * 0.67, 1.67 * 2, -0.67, 0};
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(unit[0][c], wanted[c], 1e-14);
  EXPECT_NEAR(von_mises_of(unit, Eigen::ArrayXd::Constant(1, -2)), 2 * von_mises_Pa(wanted), 1e-13);
}

// A stress of order p in the cell size h: v = v0 (1 + c h^p). The change from h to h / r tells exactly what
// is missing at h / r.
TEST(LearnFromChange, IsExactForItsOrder) {
  for (const double order : {1.0, 2.0})
    for (const double ratio : {4.0 / 3, 2.0, 3.0}) {
      const auto stress = [&](double h) { return 100 * (1 - 0.2 * std::pow(h, order)); };
      ErrorBudget budget;
      budget.set_numerical({"discretisation", "", 1.0});
      learn_from_change(budget, stress(1 / ratio) - stress(1), ratio, 3, order);
      EXPECT_NEAR(budget.of("discretisation"), 100 - stress(1 / ratio), 1e-12) << ratio << ' ' << order;
      EXPECT_EQ(budget.numerical.size(), 1u);
    }
}

// Two meshes may agree by chance: the cells' own disagreement stays as a floor. Without a ratio nothing is
// learnt.
TEST(LearnFromChange, KeepsAFloorOfTheMeshesOwnEstimate) {
  ErrorBudget budget;
  budget.set_numerical({"discretisation", "", 6.0});
  ErrorBudget same = budget;
  learn_from_change(same, 3.0, 1.0);
  EXPECT_EQ(same.of("discretisation"), 6);
  for (const auto& [n_meshes, share] :
       {std::pair(2, 1.0), std::pair(3, 0.5), std::pair(4, 0.5), std::pair(9, 0.5)}) {
    ErrorBudget learnt = budget;
    learn_from_change(learnt, 0.0, 2.0, n_meshes);
    EXPECT_NEAR(learnt.of("discretisation"), share * 6 / discretisation_safety, 1e-14) << n_meshes;
  }
}

TEST(ErrorBudget, AddsUpWithoutSigns) {
  ErrorBudget budget;
  budget.set_numerical({"a", "", 1});
  budget.set_numerical({"b", "", 3});
  budget.set_numerical({"a", "", 2});
  budget.model.push_back({"beam", "", 10});
  EXPECT_EQ(budget.numerical_Pa(), 5);
  EXPECT_EQ(budget.total_Pa(), 15);
  EXPECT_EQ(budget.largest(), "b");
  EXPECT_EQ(budget.of("beam"), 10);
}

// Stress at a node is compared with that of the cells around it, over the nodes of the faces that hold it;
// one of them beside a sharp edge, whose stress has no converged value, tells nothing of the others.
TEST(ErrorBudget, NodesThatAreLeftOutTellNothing) {
  fem::UnitResponses responses;
  responses.nodes = results_test::mapped_cube(1, 1, 1, [](results_test::Point p) { return p; });
  const std::size_t n = responses.nodes.n, corner = 0, beside = 1;
  responses.channels = {"pull"};
  responses.displacement_m.assign(3 * n, 0);
  responses.stress_Pa.assign(6 * n, 0);
  responses.stress_Pa[6 * beside] = 100;    // recovered, where the cell has none
  responses.energy_error.norm_sqrtJ = {1};  // cells were solved
  Eigen::ArrayXXd values(1, 1);
  values << 1;
  const auto discretisation = [&](const std::vector<char>& left_out) {
    return self_estimate({{{corner, 1.0}}, 0}, responses, loads_of(values, {{"pull", {}}}), {2e11, 0.3, 7850},
                         0, left_out)
        .of("discretisation");
  };
  std::vector<char> left_out(n, 0);
  EXPECT_DOUBLE_EQ(discretisation({}), discretisation_safety * 100);
  EXPECT_DOUBLE_EQ(discretisation(left_out), discretisation_safety * 100);
  left_out[beside] = 1;
  EXPECT_EQ(discretisation(left_out), 0);
}

// sigma ~ h^-0.3, a re-entrant corner's power, against a stress of second order that starts as steeply.
TEST(GrowsWithoutBound, TellsACornerFromAFillet) {
  const std::vector<double> ratios{1.5, 1.5, 1.33};
  std::vector<double> corner, fillet;
  double h = 1;
  for (std::size_t i = 0; i <= ratios.size(); ++i) {
    corner.push_back(std::pow(h, -0.3));
    fillet.push_back(1 - 0.4 * h * h);
    if (i < ratios.size()) h /= ratios[i];
  }
  EXPECT_TRUE(grows_without_bound(corner, ratios));
  EXPECT_FALSE(grows_without_bound(fillet, ratios));
  for (std::size_t n : {1u, 2u})  // two meshes cannot tell
    EXPECT_FALSE(grows_without_bound({corner.begin(), corner.begin() + long(n)}, ratios));
  // Growth too slow to matter, and a stress that falls.
  EXPECT_FALSE(grows_without_bound({1, 1.01, 1.02}, {1.5, 1.5}));
  EXPECT_FALSE(grows_without_bound({1.2, 1.1, 1.0}, {1.5, 1.5}));
}

// A share of the submodel's own stress, whatever the nodes say.
TEST(ErrorBudget, ASubmodelTellsItsOwnError) {
  Eigen::ArrayXXd values(1, 1);
  values << 2;
  const StressPoint point{
      {{0, 1.0}}, 0, std::make_shared<ResolvedStress>(ResolvedStress{{{100, 0, 0, 0, 0, 0}}, 0.07})};
  const auto responses = at_one_node({{130, 0, 0, 0, 0, 0}});
  EXPECT_EQ(unit_stress_at(responses, point)[0][0], 100);
  EXPECT_DOUBLE_EQ(
      self_estimate(point, responses, loads_of(values, {{"pull", {}}}), {}, 0).of("discretisation"),
      0.07 * 200);
}
