// Each mistake must be refused with the parameter, its value and a way out.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/unit/kinetics/planetary/planetary_machines.h"

namespace {

using kinetics::PlanetaryConvention;
using kinetics::PlanetaryLengths;
using kinetics::PlanetaryMill;
using kinetics::PlanetaryRatios;

struct Mistake {
  std::function<void(PlanetaryMill&)> make;
  std::vector<std::string> effects;
  std::vector<std::string> message_has;
};

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinite = std::numeric_limits<double>::infinity();

void unchanged(PlanetaryMill&) {}
void as_plotted(PlanetaryMill& mill) {
  mill.convention = PlanetaryConvention::as_plotted;
}
PlanetaryRatios& ratios(PlanetaryMill& mill) {
  return std::get<PlanetaryRatios>(mill.geometry);
}

std::string refusal(const PlanetaryMill& mill, const std::vector<std::string>& effects,
                    kinetics::TimeGrid grid = {1, 12}) {
  try {
    compute_loads(mill, effects, grid);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::vector<Mistake>& mistakes) {
  for (const auto& mistake : mistakes) {
    auto mill = machines::printed_planetary();
    mistake.make(mill);
    const auto message = refusal(mill, mistake.effects);
    for (const auto& part : mistake.message_has)
      EXPECT_NE(message.find(part), std::string::npos) << "wanted: " << part << "\n   got: " << message;
  }
}

bool warned(const PlanetaryMill& mill, const std::string& of) {
  for (const auto& warning : compute_loads(mill, {}, {1, 12}).warnings)
    if (warning.find(of) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST(PlanetaryWrongInput, Parameters) {
  expect_refused({
      {[](auto& m) { m.gravity_m_s2 = -9.81; }, {}, {"gravity = -9.81", "must not be negative"}},
      {[](auto& m) { m.speed_rad_s = 0; }, {}, {"speed = 0", "must be positive", "mirror"}},
      {[](auto& m) { m.speed_rad_s = infinite; }, {}, {"speed = inf", "finite"}},
      {[](auto& m) { m.initial_angle_rad = not_a_number; }, {}, {"initial_angle = nan"}},
      {[](auto& m) { m.initial_drum_angle_rad = infinite; }, {}, {"initial_drum_angle = inf"}},
      {[](auto& m) { m.drum_radius_m = 0; }, {}, {"drum_radius = 0", "must be positive"}},
      {[](auto& m) { m.drum_length_m = -1; }, {}, {"drum_length = -1"}},
      {[](auto& m) { m.drum_length_m = 0; }, {"charge_gravity"}, {"drum_length = 0", "charge_gravity"}},
      {[](auto& m) { m.drum_mass_kg = -1; }, {}, {"drum_mass = -1"}},
      {[](auto& m) { m.drum_mass_kg = 0; }, {"drum_gravity"}, {"drum_mass = 0", "drum_gravity"}},
      {[](auto& m) { m.drum_mass_kg = 0; }, {"drum_transport"}, {"drum_mass = 0", "drum_transport"}},
      {[](auto& m) { m.charge.bulk_density_kg_m3 = 0; },
       {"charge_offset"},
       {"charge.bulk_density = 0", "charge_offset"}},
      {[](auto& m) { m.charge.bulk_density_kg_m3 = not_a_number; }, {}, {"charge.bulk_density = nan"}},
      {[](auto& m) { m.charge.segment_angle_rad = infinite; }, {}, {"charge.segment_angle = inf"}},
      {[](auto& m) { ratios(m).k = 1; }, {}, {"geometry.k = 1", "below 1"}},
      {[](auto& m) { ratios(m).k = 0; }, {}, {"geometry.k = 0", "positive"}},
      {[](auto& m) { ratios(m).b = -1; }, {}, {"geometry.b = -1"}},
      {[](auto& m) { ratios(m).c = not_a_number; }, {}, {"geometry.c = nan"}},
      {[](auto& m) {
         m.geometry = PlanetaryLengths{0, 0.2, 0.1};
       },
       {},
       {"geometry.carrier_length = 0"}},
      {[](auto& m) {
         m.geometry = PlanetaryLengths{1, -0.2, 0.1};
       },
       {},
       {"geometry.central_pulley_radius = -0.2"}},
      {[](auto& m) {
         m.geometry = PlanetaryLengths{1, 0.2, 0};
       },
       {},
       {"geometry.drum_pulley_radius = 0"}},
  });
}

TEST(PlanetaryWrongInput, Filling) {
  const std::vector<std::string> on{"charge_transport"};
  const auto give = [](std::optional<double> filling, std::optional<double> empty,
                       std::optional<double> gamma) {
    return [=](PlanetaryMill& m) {
      m.charge.filling = filling, m.charge.void_fraction = empty, m.charge.half_angle_rad = gamma;
    };
  };
  expect_refused({
      {give({}, {}, {}), on, {"none is given", "exactly one"}},
      {give(0.5, {}, 1.0), on, {"more than one"}},
      {give(0.5, 0.5, {}), {}, {"more than one"}},
      {give(1.1, {}, {}), on, {"charge.filling = 1.1", "between 0 and 1"}},
      {give(not_a_number, {}, {}), on, {"charge.filling = nan"}},
      {give({}, -0.1, {}), on, {"charge.void_fraction = -0.1"}},
      {give({}, {}, 90.0), on, {"charge.half_angle = 90", "3.14159", "rad"}},
  });
  auto mill = machines::printed_planetary();
  mill.charge = {};
  EXPECT_EQ(refusal(mill, {"drum_transport", "drum_gravity", "belt"}), "accepted");
}

TEST(PlanetaryWrongInput, Belt) {
  expect_refused({
      {[](auto& m) { m.belt = kinetics::RatioBelt{1}; }, {}, {"belt.ratio = 1", "above 1"}},
      {[](auto& m) { m.belt = kinetics::RatioBelt{not_a_number}; }, {}, {"belt.ratio = nan"}},
      {[](auto& m) { m.belt = kinetics::EytelweinBelt{0}; }, {}, {"belt.friction = 0", "positive"}},
      {[](auto& m) {
         m.belt = kinetics::PretensionedBelt{-1, 0.3};
       },
       {},
       {"belt.pretension = -1"}},
      {[](auto& m) {
         m.belt = kinetics::PretensionedBelt{1, 0};
       },
       {},
       {"belt.friction = 0"}},
  });
}

TEST(PlanetaryWrongInput, Effects) {
  expect_refused({
      {unchanged, {"drum_gravty"}, {"drum_gravty: unknown", "did you mean drum_gravity?"}},
      {unchanged, {"belt", "drum_gravity", "belt"}, {"belt: named twice"}},
      {unchanged, {"charge_relative"}, {"charge_relative", "is called charge_offset", "\"consistent\""}},
      {as_plotted, {"charge_offset"}, {"charge_offset", "is called charge_relative", "\"as_plotted\""}},
      {unchanged, {"drum_spin"}, {"drum_spin", "mesh"}},
      {unchanged, {"drive_couple"}, {"drive_couple", "belt is off"}},
  });
}

TEST(PlanetaryWrongInput, MachinesThatCannotBeBuilt) {
  expect_refused({
      {[](auto& m) {
         ratios(m) = {0.26, 1, 0.5};
       },
       {},
       {"geometry.k = 0.26", "pulleys overlap", "c / (1 + 2c)"}},
      {[](auto& m) {
         ratios(m) = {0.4, 1, 0.3};
       },
       {},
       {"geometry.c = 0.3", "no belt exists", "at least k"}},
      {[](auto& m) {
         ratios(m) = {0.2, 4.1, 1};
       },
       {},
       {"opposite drums overlap", "must exceed b"}},
      {[](auto& m) {
         m.geometry = PlanetaryLengths{0.29, 0.2, 0.1};
       },
       {},
       {"geometry.carrier_length = 0.29", "pulleys overlap", "0.3 m"}},
      {[](auto& m) {
         m.geometry = PlanetaryLengths{0.1, 0.02, 0.01};
       },
       {},
       {"geometry.carrier_length = 0.1", "drum_radius = 0.1"}},
      {[](auto& m) { m.belt_beyond_geometry = true; }, {}, {"belt.beyond_geometry", "as_plotted"}},
  });
}

// The conventions of the paper compute what it plots, and say that it cannot be built.
TEST(PlanetaryWrongInput, ThePapersMachinesAreWarnedOf) {
  auto mill = machines::printed_planetary();
  as_plotted(mill);
  ratios(mill) = {0.4, 1, 0.5};
  EXPECT_TRUE(warned(mill, "pulleys overlap"));
  EXPECT_FALSE(warned(mill, "no belt exists"));
  ratios(mill) = {0.4, 1.6, 0.5};
  EXPECT_TRUE(warned(mill, "opposite drums overlap"));
  ratios(mill) = {0.4, 1, 0.2};
  EXPECT_NE(refusal(mill, {}).find("set belt.beyond_geometry"), std::string::npos) << refusal(mill, {});
  mill.belt_beyond_geometry = true;
  EXPECT_TRUE(warned(mill, "cos beta is taken as zero"));
  mill.belt = kinetics::EytelweinBelt{0.3};
  EXPECT_NE(refusal(mill, {}).find("no wrap"), std::string::npos) << refusal(mill, {});
}

// Where w differs from Omega the forces still close, so closure alone would let it pass.
TEST(PlanetaryWrongInput, ThePapersOffsetSpeedIsWarnedOf) {
  auto mill = machines::printed_planetary();
  as_plotted(mill);
  EXPECT_TRUE(compute_loads(mill, {"charge_relative"}, {1, 12}).warnings.empty());
  ratios(mill).c = 0.8;
  const auto loads = compute_loads(mill, {"charge_relative"}, {1, 12});
  ASSERT_EQ(loads.warnings.size(), 1u);
  EXPECT_NE(loads.warnings[0].find("0.0625 times"), std::string::npos) << loads.warnings[0];
}

TEST(PlanetaryWrongInput, Grid) {
  EXPECT_NE(refusal(machines::printed_planetary(), {}, {0, 12}).find("turns = 0"), std::string::npos);
  EXPECT_NE(refusal(machines::printed_planetary(), {}, {1, 3}).find("instants_per_turn = 3"),
            std::string::npos);
}
