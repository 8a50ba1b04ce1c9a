#include <gtest/gtest.h>

#include <functional>

#include "fem/equations/loads/surface_loads.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;

template <typename Error>
std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

struct Refusals : testing::Test {
  static void SetUpTestSuite() { rod = new fem_tests::ShaftBody(fem_tests::rod(8)); }
  static void TearDownTestSuite() { delete rod; }
  static fem_tests::ShaftBody* rod;
};
fem_tests::ShaftBody* Refusals::rod;

TEST_F(Refusals, Loads) {
  const fem::Model model(rod->body);
  const auto load = fem_tests::resultant(*rod, "end_1", Component::fz);
  const auto refused = [&](const std::vector<fem::UnitLoad>& loads) {
    return message<std::invalid_argument>([&] { model.unit_responses(loads, {}); });
  };
  expect_words(refused({}), {"no unit loads"});
  expect_words(refused({load, load}), {"end_1.fz", "twice"});
  auto nowhere = std::get<fem::SurfaceResultant>(load.shape);
  nowhere.surface.boundary_id = 987;
  expect_words(refused({{"hub.fz", nowhere}}), {"hub.fz", "no faces", "987"});
  const auto& seat = rod->ports.at("rod");
  const auto sine = fem::SeatPressure::Phase::sine, cosine = fem::SeatPressure::Phase::cosine;
  expect_words(refused({{"rod.p1", fem::SeatPressure{seat, 1, 1, cosine}}}),
               {"rod.p1", "harmonic 1", "resultant"});
  expect_words(refused({{"rod.p0", fem::SeatPressure{seat, 0, 1, sine}}}), {"no sine phase"});
  expect_words(refused({{"end.p2", fem::SeatPressure{rod->ports.at("end_1"), 2, 1, cosine}}}),
               {"need a seat"});
  auto flat = seat;
  flat.axial_profile = {0, 0};
  expect_words(refused({{"rod.p2", fem::SeatPressure{flat, 2, 1, cosine}}}), {"rod.p2", "axial profile"});
  expect_words(refused({{"core.ax", fem::BodyForce{fem::BodyForce::Field::translation_x, {987}}}}),
               {"core.ax", "volume group 987"});
}

TEST_F(Refusals, MaterialsAndDegrees) {
  const auto refused = [&](const std::function<void(fem::Body&)>& change) {
    auto body = rod->body;
    change(body);
    return message<std::invalid_argument>([&] { fem::Model model(body); });
  };
  expect_words(refused([](auto& b) { b.material.poisson_ratio = 0.5; }), {"material.poisson_ratio = 0.5"});
  expect_words(refused([](auto& b) { b.material.youngs_modulus_Pa = 0; }), {"material.youngs_modulus"});
  expect_words(refused([](auto& b) { b.material.density_kg_m3 = -1; }), {"material.density"});
  expect_words(refused([](auto& b) { b.degree = 4; }), {"degree = 4"});
  expect_words(refused([](auto& b) { b.cylinders[0].volume_id = 55; }), {"volume 55", "no cells"});
  expect_words(refused([](auto& b) { b.tori.push_back({56, 0, 1, 0.1}); }), {"group 56", "no faces"});
}

TEST_F(Refusals, InvertedCells) {
  auto grid = fem::make_grid(rod->body);
  EXPECT_NO_THROW(fem::refuse_inverted_cells(grid));
  const auto corner = grid.nodes_of(5)[0], opposite = grid.nodes_of(5)[26];
  for (int d = 0; d < 3; ++d) grid.xyz_m[3 * corner + d] = 1.5 * grid.xyz_m[3 * opposite + d];
  expect_words(message<std::runtime_error>([&] { fem::refuse_inverted_cells(grid); }),
               {"inverted", "volume"});
}

TEST_F(Refusals, ASeatThatDoesNotGoRoundItsAxis) {
  auto half = rod->body;
  auto grid = fem::make_grid(half);
  const auto& port = rod->ports.at("end_1");
  auto seat = port;  // a flat face cannot be a seat: its normal pressure has no force across the axis
  seat.kind = fem::LoadSurface::Kind::seat;
  seat.length_m = 0.01;
  expect_words(message<std::runtime_error>([&] { fem::LoadedSurface surface(grid, seat); }),
               {"six independent"});
}

}  // namespace
