/// What a living page is made of, against the sums that it stands for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pipelines/base/common/constants.h"
#include "pipelines/write/exports/html_page.h"
#include "pipelines/write/living/factor_signals.h"
#include "pipelines/write/living/field_modes.h"
#include "pipelines/write/living/living_page.h"
#include "pipelines/write/living/packed_block.h"
#include "pipelines/write/living/page_surface.h"
#include "pipelines/write/living/time_basis.h"

using namespace pipelines;
using Eigen::ArrayXXd;
using Eigen::Index;

namespace {

Eigen::MatrixXd random_entries(Index rows, Index columns, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> number;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(engine); });
}

/// Largest length of the difference between the modes' sum and that of all channels.
double difference_to_modes(const UnitFields& fields, const FieldModes& modes, const ArrayXXd& factors) {
  const Index n = fields.n_nodes(), parts = fields.n_components;
  const Eigen::MatrixXd full = fields.values * factors.matrix();
  const Eigen::MatrixXd c = modes.projection * factors.matrix();
  double largest = 0;
  for (Index i = 0; i < n; ++i)
    for (Index t = 0; t < factors.cols(); ++t) {
      double square = 0;
      for (Index part = 0; part < parts; ++part) {
        double sum = 0;
        for (Index m = 0; m < modes.rank; ++m)
          sum += modes.values[std::size_t((part * modes.rank + m) * n + i)] * modes.steps[m] * c(m, t);
        square += std::pow(sum - full(i * parts + part, t), 2);
      }
      largest = std::max(largest, std::sqrt(square));
    }
  return largest;
}

/// Ten channels of unlike units, of which the factors are sums of few courses but for a small rest.
struct FewCourses {
  UnitFields fields{5, random_entries(5 * 60, 10, 1)};
  std::vector<ArrayXXd> sets;

  FewCourses() {
    for (Index k = 0; k < 10; ++k) fields.values.col(k) *= std::pow(10.0, double(k % 4) * 3);
    for (unsigned s = 0; s < 3; ++s) {
      ArrayXXd set = (random_entries(10, 3, 7) * random_entries(3, 40, 20 + s)).array() +
                     1e-3 * random_entries(10, 40, 40 + s).array();
      for (Index k = 0; k < 10; ++k) set.row(k) /= std::pow(10.0, double(k % 4) * 3);
      sets.push_back(set);
    }
  }
};

}  // namespace

// Turns red: a bound in the place of what is there, an instant or a set that is not looked at, rounding that
// is forgotten.
TEST(FieldModes, AreOffByNoMoreThanTheySay) {
  const FewCourses sample;
  for (const double tolerance : {3.0, 1e-2, 1e-6}) {
    const auto modes = field_modes(sample.fields, sample.sets, tolerance, 12);
    double largest = 0;
    for (const auto& set : sample.sets)
      largest = std::max(largest, difference_to_modes(sample.fields, modes, set));
    EXPECT_LE(largest, modes.error) << tolerance;
    // Rounding may be half the tolerance, or what 16 bits leave of stresses around 30.
    EXPECT_LE(modes.error, largest + tolerance + 0.05) << tolerance;
  }
  EXPECT_EQ(field_modes(sample.fields, sample.sets, 3.0, 12).rank, 4);
  EXPECT_EQ(field_modes(sample.fields, sample.sets, 1e-9, 8).rank, 8);  // no more than are allowed
}

TEST(FieldModes, OfNothingAreNothing) {
  const UnitFields fields{5, Eigen::MatrixXd::Zero(10, 3)};
  const auto modes = field_modes(fields, {ArrayXXd::Zero(3, 4)}, 1, 8);
  EXPECT_EQ(modes.error, 0);
  for (const auto value : modes.values) EXPECT_EQ(value, 0);
}

// Turns red: a table in another's place, a signal that is scaled by another's size.
TEST(TimeBasis, GivesEverySeriesBack) {
  std::vector<ArrayXXd> sets;
  for (unsigned s = 0; s < 4; ++s)
    sets.push_back((random_entries(6, 3, s) * random_entries(3, 50, 9)).array());
  sets[2].row(4).setZero();
  for (auto& set : sets) set.row(1) *= 1e9;
  const auto times = time_basis(sets);
  EXPECT_EQ(times.basis.rows(), 3);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ArrayXXd back = (times.tables[s] * times.basis).array();
    for (Index j = 0; j < 6; ++j)
      EXPECT_LT((back.row(j) - sets[s].row(j)).abs().maxCoeff(), 1e-5 * (j == 1 ? 1e10 : 10))
          << s << ' ' << j;
  }
}

namespace {

/// A seat with a force that turns, the fourth harmonic of its pressure, and a torque.
BodyLoads loads_of_a_seat(const Eigen::Array2Xd& force_N) {
  BodyLoads loads;
  loads.history.channels = {{"seat.fx", "N"}, {"seat.fy", "N"}, {"seat.p4s", "N"}, {"end.torque", "N m"}};
  const fem::LoadSurface surface;
  using Component = fem::SurfaceResultant::Component;
  loads.unit_loads = {{"seat.fx", fem::SurfaceResultant{surface, Component::fx}},
                      {"seat.fy", fem::SurfaceResultant{surface, Component::fy}},
                      {"seat.p4s", fem::SeatPressure{surface, 4, 0.2, fem::SeatPressure::Phase::sine}},
                      {"end.torque", fem::SurfaceResultant{surface, Component::torque}}};
  loads.pressing_force_N["seat"] = force_N;
  loads.history.values = ArrayXXd::Zero(4, force_N.cols());
  loads.history.values.topRows(2) = force_N;
  for (Index t = 0; t < force_N.cols(); ++t)  // sin(4 (a + pi)) = sin(4 a) = 4 s c (c^2 - s^2)
    if (const double x = force_N(0, t), y = force_N(1, t), f = std::hypot(x, y); f > 0)
      loads.history.values(2, t) = f * 4 * (x / f) * (y / f) * (x * x - y * y) / (f * f);
  return loads;
}

}  // namespace

// Turns red: pressure added up effect by effect, a sign of the harmonics, a channel in another's row.
TEST(FactorSignals, TurnPressureWithTheForceThatIsLeft) {
  Eigen::Array2Xd one(2, 3), other(2, 3);
  one << 3, 0, -2, 1, 5, -2;
  other << -1, 4, 1, 2, 0, 5;
  const auto both = loads_of_a_seat(one + other), left = loads_of_a_seat(one);
  const auto signals = factor_signals(both);
  ASSERT_EQ(signals.laws.size(), 1u);
  std::string trouble;
  const ArrayXXd change = signals_of(signals, both, both, trouble) - signals_of(signals, both, left, trouble);
  const auto factors = signals.factors(signals_of(signals, both, both, trouble) - change);
  EXPECT_EQ(trouble, "");
  EXPECT_LT((factors - left.history.values).abs().maxCoeff(), 1e-12);
  auto more = left;
  more.history.channels[3].name = "end.fz";
  more.history.values.row(3).setOnes();
  signals_of(signals, both, more, trouble);
  EXPECT_NE(trouble.find("end.fz"), std::string::npos);
}

namespace {

/// Two faces of four nodes, images of each other about x = 1, and one between them that is its own.
fem::Nodes three_mirrored_faces() {
  fem::Nodes nodes;
  nodes.kind = fem::CellKind::hexahedra;
  nodes.degree = 1;
  for (const double y : {0.0, 1.0})
    for (const double x : {-1.0, 0.0, 2.0, 3.0}) nodes.xyz_m.insert(nodes.xyz_m.end(), {x, y, 0});
  nodes.n = 8;
  nodes.faces = {0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6};
  return nodes;
}

}  // namespace

// Turns red: the wrong half, an image of the wrong node, a face that is shown twice.
TEST(PageSurface, IsOneHalfOfABodyThatIsItsOwnImage) {
  const auto nodes = three_mirrored_faces();
  fem::MirrorImages images;
  images.node = {3, 2, 1, 0, 7, 6, 5, 4};
  const auto half = page_surface(nodes, images, 100);
  EXPECT_EQ(half.mirror_axis, 0);
  EXPECT_DOUBLE_EQ(half.mirror_at_m, 1);
  EXPECT_EQ(half.nodes, (std::vector<std::int32_t>{2, 3, 6, 7}));
  EXPECT_EQ(half.n_doubled, 1u);
  EXPECT_EQ(half.faces, (std::vector<std::uint32_t>{0, 1, 3, 2, 4, 0, 2, 6}));
  const auto whole = page_surface(nodes, {}, 100);
  EXPECT_EQ(whole.mirror_axis, -1);
  EXPECT_EQ(whole.nodes.size(), 8u);
  EXPECT_EQ(whole.n_faces(), 3u);
}

// "foo" deflated by Python's zlib.compress(b"foo", 6), in base64.
TEST(PackedBlock, IsZlib) {
  PackedBlock block;
  block.add("three", std::vector<std::uint8_t>{'f', 'o', 'o'});
  EXPECT_EQ(base64(block.deflated()), "eJxLy88HAAKCAUU=");
  EXPECT_EQ(block.index()["three"], (summary::Json{"u8", 0, 3}));
  const auto range = block.add_range("range", {-1, 0, 3});
  EXPECT_EQ(range, (summary::Json{-1.0, 3.0}));
  EXPECT_EQ(block.index()["range"], (summary::Json{"u16", 3, 3}));
}

TEST(LivingPage, IsReadBackFromItsFile) {
  const LivingPage living{"{\"a\": 1}", std::string("x\n\0y", 4)};
  const auto read = living_of(living_file(living));
  EXPECT_EQ(read.keys, living.keys);
  EXPECT_EQ(read.data, living.data);
  EXPECT_TRUE(living_of("").empty());
  EXPECT_EQ(living_elements({}), "");
  EXPECT_NE(living_elements(living).find('>' + base64(living.data) + '<'), std::string::npos);
}
