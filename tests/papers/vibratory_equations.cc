// The vibratory mill's paper, equation by equation, as `millstress loads` puts them out: against the formulas
// written in the paper's own angles, phi and delta (the program has chi), and an independent program's
// values. Then what mechanics that closes has in their place, against its derivatives and against the forces.
#include <algorithm>
#include <cmath>

#include "tests/papers/paper_scenes.h"

using namespace cases;

namespace {

using Json = nlohmann::json;
using Numbers = std::vector<double>;
using papers::Columns;
using papers::loads_of;

// The laboratory mill, as spec and scene have it.
constexpr double ecc = 0.004, r = 0.03, omega_e = 151.844, omega_r = -1.05 * omega_e, delta0 = 1.57, g = 9.81;
constexpr double m = 20, m1 = 30, m2 = 6, m3 = 4, KE = 0.01, JE = 0.28, LE = 0.26, QE = 0.1, HE = 0.46,
                 k = 55000;

Columns published() {
  static const Columns columns = loads_of("papers/vibratory_mill.toml");
  return columns;
}

double largest_of(const Numbers& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// A series at every instant against a formula of phi and delta, which follow from the time: of angles the
/// file has fifteen digits, too few for these after 20 turns.
template <typename Formula>
void expect_series(const Columns& columns, const std::string& name, Formula formula) {
  ASSERT_TRUE(columns.count(name)) << name;
  const auto &found = columns.at(name), &time = columns.at("time");
  const double scale = largest_of(found);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], formula(omega_e * time[i], delta0 - omega_r * time[i]), 1e-11 * scale)
        << name << ' ' << i;
}

/// Derivative in time by five points around an instant.
double derivative(const Numbers& values, std::size_t i, double step_s) {
  return (values[i - 2] - 8 * values[i - 1] + 8 * values[i + 1] - values[i + 2]) / (12 * step_s);
}

}  // namespace

TEST(VibratoryEquations, Kinematics) {
  const auto q = published();
  const double a_C = omega_e * omega_e * ecc, a_OC = omega_r * omega_r * r, a_k = 2 * omega_e * omega_r * r;
  expect_series(q, "phi", [](double phi, double) { return phi; });
  expect_series(q, "C.x", [](double phi, double) { return ecc * std::cos(phi); });   // (1)
  expect_series(q, "C.y", [](double phi, double) { return -ecc * std::sin(phi); });  // (1)
  expect_series(q, "O.x", [](double phi, double delta) {                             // (4)
    return ecc * std::cos(phi) - r * std::cos(delta - phi);
  });
  expect_series(q, "O.y",
                [](double phi, double delta) { return -ecc * std::sin(phi) - r * std::sin(delta - phi); });
  expect_series(q, "chi", [](double phi, double delta) { return phi + M_PI - delta; });
  expect_series(q, "C.vx", [](double phi, double) { return -omega_e * ecc * std::sin(phi); });
  expect_series(q, "C.vy", [](double phi, double) { return -omega_e * ecc * std::cos(phi); });
  // d(delta - phi)/dt = -(omega_r + omega_e)
  expect_series(q, "O.vx", [](double phi, double delta) {
    return -omega_e * ecc * std::sin(phi) - (omega_e + omega_r) * r * std::sin(delta - phi);
  });
  expect_series(q, "O.vy", [](double phi, double delta) {
    return -omega_e * ecc * std::cos(phi) + (omega_e + omega_r) * r * std::cos(delta - phi);
  });
  expect_series(q, "a_C", [&](double, double) { return a_C; });    // (16)
  expect_series(q, "a_OC", [&](double, double) { return a_OC; });  // (20)
  expect_series(q, "a_k", [&](double, double) { return a_k; });    // (24)
  const auto a_n = [&](double, double delta) { return -a_C * std::cos(delta) + a_OC + a_k; };
  const auto a_xi = [&](double, double delta) { return a_C * std::sin(delta); };
  expect_series(q, "a_n", a_n);    // (25)
  expect_series(q, "a_xi", a_xi);  // (26)
  expect_series(q, "a_O", [&](double phi, double delta) {
    return std::hypot(a_n(phi, delta), a_xi(phi, delta));  // (27)
  });
  expect_series(q, "C.ax", [&](double phi, double) { return -a_C * std::cos(phi); });
  expect_series(q, "C.ay", [&](double phi, double) { return a_C * std::sin(phi); });
  expect_series(q, "O.ax", [&](double phi, double delta) {
    return -a_C * std::cos(phi) + (a_OC + a_k) * std::cos(delta - phi);
  });
  expect_series(q, "O.ay", [&](double phi, double delta) {
    return a_C * std::sin(phi) + (a_OC + a_k) * std::sin(delta - phi);
  });
  for (std::size_t i = 0; i < q.at("phi").size();
       ++i)  // (27) is the length of what (25) and (26) are parts of
    EXPECT_NEAR(std::hypot(q.at("O.ax")[i], q.at("O.ay")[i]), q.at("a_O")[i], 1e-11 * a_OC);
}

TEST(VibratoryEquations, Forces) {
  const auto q = published();
  const double F_d = m3 * omega_e * omega_e * KE, F_e = m * omega_e * omega_e * ecc,
               F_r = m * omega_r * omega_r * r, F_k = 2 * m * omega_e * omega_r * r;
  const auto constant = [&](const char* name, double value) {
    expect_series(q, name, [value](double, double) { return value; });
  };
  constant("F_d", F_d);                                                                             // (33)
  constant("F_e", F_e);                                                                             // (35)
  constant("F_r", F_r);                                                                             // (37)
  constant("F_k", F_k);                                                                             // (39)
  expect_series(q, "spring_force", [](double phi, double) { return k * ecc * std::sin(phi); });     // (31)
  expect_series(q, "F_ex", [&](double phi, double) { return F_e * std::cos(phi); });                // (45)
  expect_series(q, "F_ey", [&](double phi, double) { return F_e * std::sin(phi); });                // (46)
  expect_series(q, "F_rx", [&](double phi, double delta) { return F_r * std::cos(delta - phi); });  // (47)
  expect_series(q, "F_ry", [&](double phi, double delta) { return F_r * std::sin(delta - phi); });  // (48)
  expect_series(q, "F_kx", [&](double phi, double delta) { return F_k * std::cos(delta - phi); });  // (49)
  expect_series(q, "F_ky", [&](double phi, double delta) { return F_k * std::sin(delta - phi); });  // (50)
  const auto X_E = [&](double phi, double delta) {
    return -F_d * std::cos(phi) - F_e * std::cos(phi) + (F_r + F_k) * std::cos(delta - phi);
  };
  const auto Y_E = [&](double phi, double delta) {
    return (m + m1 + m2 + m3) * g - k * ecc * std::sin(phi) + (F_d + F_e) * std::sin(phi) +
           (F_r + F_k) * std::sin(delta - phi);
  };
  expect_series(q, "X_E", X_E);  // (42)
  expect_series(q, "Y_E", Y_E);  // (43)
  expect_series(q, "R_E", [&](double phi, double delta) {
    return std::hypot(X_E(phi, delta), Y_E(phi, delta));  // (44)
  });
  const auto OD = [](double phi, double delta) { return -ecc * std::sin(phi) - r * std::cos(delta - phi); };
  const auto DE = [](double phi, double delta) {
    return JE + ecc * std::cos(phi) + ecc * std::cos(phi) - r * std::cos(delta - phi);
  };
  expect_series(q, "OD", OD);  // (57)
  expect_series(q, "DE", DE);  // (58)
  const auto from_moments = [&](double phi, double delta) {
    const double od = OD(phi, delta), de = DE(phi, delta), x = std::cos(delta - phi),
                 y = std::sin(delta - phi);
    return 2 *
           (F_e * std::cos(phi) * od + F_e * std::sin(phi) * de + m * g * de - F_r * x * od + F_r * y * de -
            F_k * x * od + F_k * y * de + m1 * g * LE - m3 * g * KE * std::cos(phi)) /
           (QE + HE);
  };
  expect_series(q, "spring_force_from_moments", from_moments);  // (59)
  // (60) beside its poles, where it is the principal value.
  for (std::size_t i = 0; i < q.at("phi").size(); ++i) {
    const double phi = omega_e * q.at("time")[i], delta = delta0 - omega_r * q.at("time")[i];
    if (std::abs(std::sin(phi)) < 1e-6) continue;
    const double wanted = from_moments(phi, delta) / (ecc * std::sin(phi));
    EXPECT_NEAR(q.at("K_star")[i], wanted, 1e-9 * std::abs(wanted)) << i;
  }
}

// The first turn against the independent program's numbers, twelve digits.
TEST(VibratoryEquations, AnIndependentProgramsValues) {
  std::ifstream in(fs::path(SOURCE_DIR) / "tests/data/vibratory_mill_laboratory.json");
  const auto reference = Json::parse(in)["output"]["published"];
  const auto q = published();
  for (const char* name :
       {"X_E", "Y_E", "R_E", "spring_force", "spring_force_from_moments", "a_n", "a_xi", "a_O"}) {
    const auto wanted = reference.at(name).get<Numbers>();
    ASSERT_EQ(wanted.size(), 72u);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      EXPECT_NEAR(q.at(name)[i], wanted[i], 1e-11 * largest_of(wanted)) << name << ' ' << i;
  }
}

// Erratum 1, seen in the output: the published acceleration lacks -omega_e^2 r e(chi) to be the velocity's
// derivative.
TEST(VibratoryEquations, TheAccelerationLacksATerm) {
  const auto q = loads_of("papers/vibratory_mill.toml", "--set sampling.instants_per_turn=360");
  const double step_s = q.at("time")[1], lacking = omega_e * omega_e * r;
  for (std::size_t i = 2; i + 2 < q.at("time").size(); i += 7) {
    const double chi = q.at("chi")[i];
    // Five points miss (w h)^4 / 30 of a derivative, 3e-9 with 360 points to a turn.
    EXPECT_NEAR(derivative(q.at("O.vx"), i, step_s) - q.at("O.ax")[i], -lacking * std::cos(chi),
                1e-6 * lacking);
    EXPECT_NEAR(derivative(q.at("O.vy"), i, step_s) - q.at("O.ay")[i], lacking * std::sin(chi),
                1e-6 * lacking);
    EXPECT_NEAR(derivative(q.at("C.vx"), i, step_s), q.at("C.ax")[i], 1e-6 * omega_e * omega_e * ecc);
  }
}

// An effect that is off puts nothing out, the geometry stays.
TEST(VibratoryEquations, WhatIsOffIsNotThere) {
  const auto q =
      loads_of("papers/vibratory_mill.toml", "--set 'effects=[\"gravity_structure\", \"charge_coriolis\"]'");
  for (const char* name : {"F_d", "F_e", "F_ex", "F_r", "F_rx", "spring_force", "K_star"})
    EXPECT_EQ(q.count(name), 0u) << name;
  for (const char* name : {"F_k", "F_kx", "F_ky", "OD", "DE", "C.x", "O.ay", "a_C"})
    EXPECT_EQ(q.count(name), 1u) << name;
}

// `consistent`: velocities are the positions' derivatives, accelerations the velocities', pitch and lag
// included; and the charge presses on the wall with its weight and -m a_O.
TEST(VibratoryEquations, ConsistentMotionMakesTheForces) {
  const auto q = loads_of("vibratory_mill.toml", "--set sampling.instants_per_turn=360");
  const double step_s = q.at("time")[1];
  for (const std::string point : {"C.", "O."})
    for (const std::string axis : {"x", "y"}) {
      const auto &x = q.at(point + axis), &v = q.at(point + "v" + axis), &a = q.at(point + "a" + axis);
      const double of_v = largest_of(v), of_a = largest_of(a);
      for (std::size_t i = 2; i + 2 < x.size(); i += 7) {
        EXPECT_NEAR(derivative(x, i, step_s), v[i], 1e-6 * of_v) << point << axis << i;
        EXPECT_NEAR(derivative(v, i, step_s), a[i], 1e-6 * of_a) << point << axis << i;
      }
    }
  const double scale = largest_of(q.at("charge_on_wall.fx"));
  for (std::size_t i = 0; i < q.at("time").size(); ++i) {
    EXPECT_NEAR(q.at("charge_on_wall.fx")[i], -m * q.at("O.ax")[i], 1e-11 * scale);
    EXPECT_NEAR(q.at("charge_on_wall.fy")[i], -m * (q.at("O.ay")[i] + g), 1e-11 * scale);
    // DE and OD without errata 3 and 4: the charge's centre from the moving pivot at rest.
    EXPECT_NEAR(q.at("charge_at.x")[i], JE + r * std::cos(q.at("chi")[i]), 1e-14);
    EXPECT_NEAR(q.at("charge_at.y")[i], 0.04 - r * std::sin(q.at("chi")[i]), 1e-14);
  }
  // Without pitch and lag the motion is that of (1) and (4).
  const auto held =
      loads_of("vibratory_mill.toml",
               "--set 'effects=[\"gravity_charge\", \"charge_translation\", \"charge_centripetal\", "
               "\"charge_coriolis\", \"charge_relative\"]' --set sampling.instants_per_turn=72");
  const auto q_published = published();
  for (const char* name : {"C.x", "C.y", "C.vx", "C.ay", "O.x", "O.y", "O.vx", "O.vy"}) {
    const auto &found = held.at(name), &wanted = q_published.at(name);
    const double of_found = largest_of(found);
    for (std::size_t i = 0; i < held.at("time").size(); ++i)
      EXPECT_NEAR(found[i], wanted[i], 1e-12 * of_found) << name;
  }
}
