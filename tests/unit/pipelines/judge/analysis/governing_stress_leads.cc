/// What a body is judged by, and how it is told.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/governing_stress.h"

using namespace pipelines;

namespace {

Judged body(double peak_MPa, double hot_spot_MPa) {
  Judged analysis;
  analysis.scene.yield_strength_Pa = 235e6;
  analysis.peak.value_Pa = peak_MPa * 1e6;
  analysis.peak.feature = "tube outside";
  analysis.peak.place = Place::free_surface;
  analysis.peak.errors.set_numerical({"discretisation", "", 1e6});
  if (hot_spot_MPa > 0) {
    analysis.hot_spots.resize(2);
    analysis.hot_spots[0].name = "web 1, lower edge";
    analysis.hot_spots[0].toe_m = {0.1, 0.2, 0.3};
    analysis.hot_spots[0].von_mises_Pa = hot_spot_MPa * 1e6;
    analysis.hot_spots[0].error_Pa = 8e6;
    analysis.hot_spots[1].name = "web 2, lower edge";
    analysis.hot_spots[1].von_mises_Pa = 0.5 * hot_spot_MPa * 1e6;
    analysis.hot_spots[1].error_Pa = 6e6;
    analysis.hot_spot_errors.set_numerical({"discretisation", "", 2e6});
  }
  return analysis;
}

}  // namespace

// The laboratory chamber's safety was told as 10.59 while a weld toe has 5.72.
TEST(GoverningStress, HasTheLeastSafety) {
  const auto chamber = governing_stress(body(22.2, 41.1));
  EXPECT_EQ(chamber.kind, GoverningStress::Kind::hot_spot);
  EXPECT_EQ(chamber.place, "web 1, lower edge");
  EXPECT_EQ(chamber.position_m, (std::array<double, 3>{0.1, 0.2, 0.3}));
  EXPECT_DOUBLE_EQ(chamber.safety, 235 / 41.1);
  EXPECT_EQ(chamber.errors.numerical_Pa(), 2e6);
  const auto above_toes = governing_stress(body(50, 41.1));
  EXPECT_EQ(above_toes.kind, GoverningStress::Kind::peak);
  EXPECT_EQ(above_toes.place, "tube outside");
  EXPECT_DOUBLE_EQ(above_toes.safety, 235.0 / 50);
  EXPECT_EQ(governing_stress(body(50, 0)).name(), "peak von Mises stress");
}

// A search that has learnt of the first toe's error corrects that, and only that which governs.
TEST(GoverningStress, TakesWhatASearchHasLearnt) {
  for (const double peak_MPa : {22.2, 50.0}) {
    auto analysis = body(peak_MPa, 41.1);
    errors_of_governing(analysis).set_numerical({"discretisation", "", 7e6});
    EXPECT_EQ(governing_stress(analysis).errors.numerical_Pa(), 7e6);
    EXPECT_EQ(analysis.peak.errors.numerical_Pa(), peak_MPa == 50 ? 7e6 : 1e6);
  }
  // The table of weld toes states what the search knows of each: it said 37.7 +- 50 MPa of a toe beside a
  // headline of 38.8 +- 5.4 MPa that had 5.9 MPa for it.
  auto analysis = body(22.2, 41.1);
  analysis.hot_spots[0].name = "web 1, lower edge";
  analysis.hot_spots[1].name = "web 1, upper edge";
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.hot_spots[0]), 2e6);
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.hot_spots[1]), 6e6) << "of this mesh alone";
  analysis.place_stresses = {{"web 1, upper edge", 0, 37e6, 1.5e6, {}}};
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.hot_spots[1]), 1.5e6);
  // The mirror image of the first toe had 0.8 MPa beside 1.1 MPa, for want of what is no error of the mesh.
  analysis.hot_spot_errors.set_numerical({"pressure_harmonics", "", 0.4e6});
  analysis.hot_spot_errors.set_numerical({"other_places", "", 3e6});
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.hot_spots[0]), 5.4e6);
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.hot_spots[1]), 1.7e6);
}

// What lives are judged by: a toe was 37.7 +- 1.1 and +- 2.4 MPa from load patches, and its life took the
// mesh's share alone. Turns red: any entry that is left out, or the second toe by the first one's own error.
TEST(GoverningStress, ToesHaveTheWholeErrorOfTheirStatement) {
  auto analysis = body(22.2, 40);
  const auto share = [&](std::size_t toe) { return whole_error_share(analysis, analysis.hot_spots[toe]); };
  EXPECT_FALSE(std::isfinite(share(0))) << "not judged";
  analysis.place_stresses = {{"web 1, lower edge", 0, 40e6, 2e6, {}},
                             {"web 2, lower edge", 0, 20e6, 3e6, {}}};
  EXPECT_DOUBLE_EQ(share(0), 2.0 / 40);
  EXPECT_DOUBLE_EQ(share(1), 3.0 / 20);
  analysis.hot_spot_errors.set_numerical({"pressure_harmonics", "", 0.4e6});
  analysis.hot_spot_errors.set_model({"load_patches", "", 2.4e6});
  analysis.hot_spot_errors.set_model({"quasi_static", "", 0.8e6});
  EXPECT_DOUBLE_EQ(share(0), analysis.hot_spot_errors.total_Pa() / 40e6);
  EXPECT_NEAR(share(1), 3.0 / 20 + 0.4 / 40 + 0.8 / 40, 1e-12) << "no pressure reaches it";
}

// Of places on the surface: what is stated of the peak's assumptions counts everywhere, its whole statement
// at its own feature.
TEST(GoverningStress, PlacesHaveTheAssumptionsOfThePeak) {
  auto analysis = body(50, 0);
  analysis.envelope.von_mises.value_Pa = {50e6, 10e6};
  analysis.responses.nodes.xyz_m.assign(6, 0.0);
  analysis.peak.errors.set_model({"quasi_static", "", 4e6});
  for (const std::size_t node : {0, 1})
    EXPECT_NEAR(model_error_share(analysis, "seat", node), 0.08, 1e-12) << node;
  EXPECT_NEAR(stated_error_share(analysis, "tube outside"), 0.1, 1e-12) << "1 and 4 of 50 MPa";
  EXPECT_EQ(stated_error_share(analysis, "seat"), 0);
  analysis.peak.errors.set_model({"load_patches", "", 3e6});
  EXPECT_NEAR(model_error_share(analysis, "seat", 1), 0.08, 1e-12) << "these are asked of each place";
  EXPECT_NEAR(stated_error_share(analysis, "tube outside"), 0.16, 1e-12);
  analysis.peak.errors.set_model({"model", "", 2e6});
  EXPECT_NEAR(model_error_share(analysis, "seat", 1), 0.12, 1e-12) << "a cheap model's share, too";
}

TEST(GoverningStress, ZonesHaveTheirOwnErrorsAndTheFirstThatOfThePeak) {
  auto analysis = body(22.2, 0);
  analysis.peak.node = 7;
  Zone zone;
  zone.peak_node = 7;
  zone.error_Pa = 3e6;
  EXPECT_EQ(error_Pa(analysis, zone), 1e6);
  zone.peak_node = 8;
  EXPECT_EQ(error_Pa(analysis, zone), 3e6);
  zone.error_Pa.reset();
  EXPECT_FALSE(error_Pa(analysis, zone).has_value());
}

// Harmonics take an eccentric segment as concentric. The share by which that moves its fillets did for its
// seat, too: 19.0 +- 1.4 MPa beside a fillet of 98.6 +- 6.7, where a solid has 22.2 and 103.5.
TEST(GoverningStress, HarmonicsBesideAnEccentricSegmentAreOffByPascals) {
  auto analysis = body(100, 0);
  analysis.method = Method::axisymmetric;
  analysis.peak.errors.set_model({"eccentric_segments", "", 6e6});
  analysis.peak.errors.set_model({"offset_axis", "", 0.5e6});
  analysis.mesh.sections.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    analysis.mesh.sections[i].z_m = 0.1 * double(i);
    analysis.mesh.sections[i].radius_m = 0.02;
  }
  analysis.mesh.sections[1].axis_x_m = 3e-3;
  analysis.place_stresses = {{"fillet", 0, 100e6, 1e6, {0.02, 0, 0.13}},
                             {"seat", 1, 19e6, 0.2e6, {0.02, 0, 0.1}},
                             {"far", 2, 19e6, 0.2e6, {0.02, 0, 0.2}}};
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.place_stresses[0]), 7.5e6);
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.place_stresses[1]), 6.7e6);
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.place_stresses[2]), 0.2e6 + 0.065 * 19e6);
  Zone zone;
  zone.peak_node = 1;
  zone.peak_Pa = 19e6;
  zone.error_Pa = 0.2e6;
  zone.peak_m = {0.02, 0, 0.1};
  EXPECT_DOUBLE_EQ(*error_Pa(analysis, zone), 6.7e6);
  // On the other side of a fillet, where the step is lower: 162 MPa, where a solid has 121.
  zone.feature = "fillet";
  zone.peak_Pa = 98e6;
  EXPECT_DOUBLE_EQ(*error_Pa(analysis, zone), 0.2e6 + 2.5 * 6.5e6);
  // The largest stress may be elsewhere: what counts is the largest one beside eccentric segments.
  analysis.place_stresses[0].position_m[2] = 0.2;
  EXPECT_DOUBLE_EQ(error_Pa(analysis, analysis.place_stresses[1]), 0.2e6 + 0.06 * 19e6 + 0.5e6);
}

// What a tolerance is compared with is the figure that stands first; what no mesh lowers has its own name.
TEST(ErrorText, SetsApartWhatNoMeshLowers) {
  ErrorBudget errors;
  errors.set_numerical({"discretisation", "", 1.1e6});
  errors.set_numerical({"pressure_harmonics", "", 0.2e6});
  EXPECT_EQ(value_with_errors(105.2e6, errors), "105.2 MPa +- 1.3 (numerical)");
  EXPECT_EQ(value_with_shares(105.2e6, errors), "105.2 +- 1.3 MPa");
  errors.set_model({"load_patches", "", 2.1e6});
  errors.set_model({"quasi_static", "", 1e3});
  EXPECT_EQ(value_with_errors(105.2e6, errors),
            "105.2 MPa +- 1.3 (numerical) and +- 2.1 from load patches, which no mesh lowers");
}

// A drum that spins slowly: 0.08907 MPa +- 8.98e-05 was shown as 0.1, which is outside of that.
TEST(ErrorText, ShowsAsManyDigitsAsAreKnown) {
  const auto text = [](double value_Pa, double error_Pa) {
    ErrorBudget errors;
    errors.set_numerical({"discretisation", "", error_Pa});
    return value_with_errors(value_Pa, errors);
  };
  EXPECT_EQ(text(0.08907e6, 89.8), "0.08907 MPa +- 8.98e-05 (numerical)");
  EXPECT_EQ(text(0.08907e6, 0.05e6), "0.0891 MPa +- 0.1 (numerical)");
  EXPECT_EQ(text(43.1349e6, 0.012e6), "43.13 MPa +- 0.012 (numerical)");
  EXPECT_EQ(text(43.1349e6, 0.06e6), "43.1 MPa +- 0.1 (numerical)");
  EXPECT_EQ(text(431.349e6, 1e-3), "431.34900 MPa +- 1e-09 (numerical)");
  EXPECT_EQ(text(0, 0), "0.0 MPa +- 0.0 (numerical)");
  EXPECT_EQ(text(1e-6, 1e-9), "1e-12 MPa +- 1e-15 (numerical)");
  EXPECT_EQ(text(2e13, 1e6), fixed(2e7, 1) + " MPa +- 1.0 (numerical)");
}

// Four digits at most; what is shown is never narrower than what is stated. Turns red: errors that are
// rounded to the nearest, or vanish beside a value of four digits.
TEST(ErrorText, ShowsFourDigitsAndNeverLessError) {
  EXPECT_EQ(with_error(66.0725e6, 1.6e6), "66.07 +- 1.61")
      << "1.60 and what rounding of the value leaves out";
  EXPECT_EQ(with_error(104.94e6, 3.21e6), "104.9 +- 3.3");
  EXPECT_EQ(with_error(41.56136e6, 57.9), "41.56 +- 0.01");
  EXPECT_EQ(with_error(1234.4e6, 3.2e6), "1234 +- 4");
  EXPECT_EQ(with_error(41.56e6, 0), "41.56 +- 0.00");
  EXPECT_EQ(with_error(41.56e6, std::numeric_limits<double>::infinity()), "41.56 +- ?");
  EXPECT_EQ(with_error(0, 0), "0.000 +- 0.000");
  EXPECT_EQ(with_error(0.0123456e6, 0.001e6), "0.01235 +- 0.00101");
}

TEST(ErrorText, TellsWhatIsNotKnownWellAndWhatHelps) {
  GoverningStress stress;
  stress.value_Pa = 30.8e6;
  stress.errors.set_numerical({"discretisation", "", 6.1e6});
  Search search;
  EXPECT_EQ(not_known_well(stress, search), "");
  stress.errors.set_numerical({"discretisation", "", 12.8e6});
  EXPECT_EQ(not_known_well(stress, search),
            "30.8 MPa +- 12.8 MPa (42 %): discretisation; remedy: --tolerance \"5 %\"");
  search.steps.resize(1);
  search.met = false;
  search.ended = "the time is up";
  EXPECT_NE(not_known_well(stress, search).find("remedy: more time (--time-limit)"), std::string::npos);
  search.met = true;  // where time alone was limited: no tolerance could be smaller
  EXPECT_NE(not_known_well(stress, search).find("remedy: more time (--time-limit)"), std::string::npos);
  search.met = false;
  search.ended = "the mesh cannot be refined further";
  EXPECT_NE(not_known_well(stress, search).find("remedy: another mesh, since the mesh cannot be refined"),
            std::string::npos);
  stress.errors.set_model({"load_patches", "", 20e6});
  EXPECT_NE(not_known_well(stress, search).find("(106 %): load patches; remedy: give the seats' pressure"),
            std::string::npos);
  stress.value_Pa = 0;
  EXPECT_EQ(not_known_well({}, search), "") << "nothing is stressed";
}
