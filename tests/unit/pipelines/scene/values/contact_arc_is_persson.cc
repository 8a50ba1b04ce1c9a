/// Arcs of contact against Hertz, Persson's arc without clearance and contact solutions by complementarity.
#include "pipelines/scene/values/contact_arc.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using pipelines::ConformingContact;
using pipelines::half_arc_rad;

constexpr double degree = M_PI / 180;
constexpr double plane_modulus_Pa = 206e9 / (1 - 0.3 * 0.3);

double half_arc_deg(double radius_m, double clearance_m, double force_N_m, bool hub_is_stiff) {
  return half_arc_rad({radius_m, clearance_m, force_N_m, plane_modulus_Pa, hub_is_stiff}) / degree;
}

}  // namespace

// Half width a = sqrt(4 Q R' / (pi E*)), R' = R^2 / dR, E* half the plane modulus for two alike, the whole of
// it in a stiff hub. At 2.7 and 6.1 degrees the arc's curvature is worth (a / R)^2.
TEST(ContactArc, NarrowOnesAreThoseOfHertz) {
  const double R = 0.03, dR = 100e-6;
  for (const double Q : {2e4, 1e5})
    for (const bool stiff : {false, true}) {
      const double modulus = (stiff ? 1 : 0.5) * plane_modulus_Pa;
      const double hertz = std::sqrt(4 * Q * R * R / dR / (M_PI * modulus)) / R;
      EXPECT_NEAR(half_arc_deg(R, 2 * dR, Q, stiff) * degree / hertz, 1, hertz * hertz) << Q << stiff;
    }
}

// E' dR / Q printed for arcs of Persson's disc: 2 - ln(x + 1) - 2 x^2 = 0 at 84.8 degrees, whatever the
// force; and a cylinder in a wide hole touches along a line.
TEST(ContactArc, EndsWithoutClearanceAtPerssonsArc) {
  for (const double Q : {1.0, 1e5, 1e9})
    for (const bool stiff : {false, true}) EXPECT_NEAR(half_arc_deg(0.03, 0, Q, stiff), 84.8, 0.05);
  EXPECT_LT(half_arc_deg(0.03, 0.01, 1, false), 0.01);
}

// Complementarity with 96 points round a solid seat in a stiff hub, its compliance by finite elements: arcs
// at the largest force, known to half a point, 1.9 degrees, and rounded to degrees.
TEST(ContactArc, SolidSeatsInStiffHubsAreThoseOfContact) {
  struct Row {
    double radius_m, length_m, force_N, clearance_um, half_arc_deg;
  };
  for (const auto& row :
       {Row{0.030, 0.060, 4900, 10, 17}, Row{0.030, 0.060, 4900, 50, 9}, Row{0.030, 0.060, 4900, 200, 5},
        Row{0.030, 0.060, 49000, 10, 41}, Row{0.030, 0.060, 49000, 50, 22}, Row{0.030, 0.060, 49000, 200, 13},
        Row{0.0175, 0.021, 3000, 10, 22}, Row{0.0175, 0.021, 3000, 50, 11}, Row{0.0175, 0.021, 3000, 200, 6}})
    EXPECT_NEAR(half_arc_deg(row.radius_m, 1e-6 * row.clearance_um, row.force_N / row.length_m, true),
                row.half_arc_deg, 1.9 + 0.5 + (row.half_arc_deg > 30 ? 0.1 * row.half_arc_deg : 0))
        << row.radius_m << ' ' << row.force_N << ' ' << row.clearance_um;
}

TEST(ContactArc, RefusesWhatIsNoContact) {
  const ConformingContact contact{0.03, 1e-5, 1e5, plane_modulus_Pa, true};
  for (const auto change :
       {+[](ConformingContact& c) { c.radius_m = 0; }, +[](ConformingContact& c) { c.clearance_m = -1e-6; },
        +[](ConformingContact& c) { c.force_N_m = 0; },
        +[](ConformingContact& c) { c.plane_modulus_Pa = std::nan(""); }}) {
    auto wrong = contact;
    change(wrong);
    EXPECT_THROW(half_arc_rad(wrong), std::invalid_argument);
  }
}
