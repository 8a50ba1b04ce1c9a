/// A promise about the largest stress of a body is one about every place that may hold it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "meshes/values/refused.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/search/models/search_mesh.h"
#include "pipelines/search/refinement/place_history.h"
#include "pipelines/search/refinement/refinement.h"
#include "tests/unit/pipelines/examples/row_of_cells.h"

using namespace pipelines;

namespace {

PlaceStress place(const std::string& feature, double value, double error) {
  return {feature, 0, value, error, {}};
}

double error_of(const std::vector<PlaceStress>& places, const std::string& feature) {
  for (const auto& p : places)
    if (p.feature == feature) return p.error_Pa;
  return -1;
}

const std::vector<MeshPart> parts_of_a_shaft{MeshPart::fillets, MeshPart::around, MeshPart::along};

}  // namespace

// The seat leads with a small error; a fillet of few cells may be higher: the body is known no better than
// that.
TEST(PlaceJudgement, APlaceThatMayBeHigherCounts) {
  const std::vector<PlaceStress> places{place("fillet a/b", 76, 38), place("seat", 79, 2),
                                        place("end", 10, 10)};
  const auto judgement = judge(places);
  EXPECT_EQ(places[judgement.governing].feature, "seat");
  EXPECT_EQ(places[judgement.holding_back].feature, "fillet a/b");
  EXPECT_EQ(judgement.other_place, "fillet a/b");
  EXPECT_DOUBLE_EQ(79 + 2 + judgement.other_places_Pa, 76 + 38);
}

TEST(PlaceJudgement, WhatIsLowEvenWithItsErrorDoesNot) {
  const std::vector<PlaceStress> places{place("fillet a/b", 70, 10), place("seat", 79, 2)};
  const auto judgement = judge(places);
  EXPECT_EQ(judgement.holding_back, judgement.governing);
  EXPECT_EQ(judgement.other_places_Pa, 0);
  EXPECT_EQ(judgement.other_place, "");
}

// Two faces side by side: the node on their seam belongs to both, the excluded one to none.
TEST(Places, ASeamBelongsToBothOfItsFeatures) {
  fem::Nodes nodes;
  nodes.degree = 1;
  nodes.n = 7;  // the last one on no face
  nodes.xyz_m.assign(21, 0);
  nodes.faces = {0, 1, 4, 3, 1, 2, 5, 4};
  nodes.face_boundary_id = {7, 9};
  const std::vector<meshes::Feature> features{{"fillet", meshes::Feature::Kind::fillet, 7, 0, 0},
                                              {"cylinder", meshes::Feature::Kind::surface, 9, 0, 0}};
  NodePlaces at;
  at.feature_names = {"fillet", "cylinder"};
  at.feature = {0, 0, 1, 0, 0, 1, -1};
  at.excluded = {0, 0, 0, 1, 0, 0, 0};
  // What is inside and well below the surface only tells how near the next node is.
  EXPECT_EQ(largest_by_feature(nodes, {1, 5, 2, 99, 4, 3, 4}, features, at).size(), 2U);
  const auto places = largest_by_feature(nodes, {1, 5, 2, 99, 4, 3, 6}, features, at);
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[0].node, 1U);
  EXPECT_EQ(places[1].node, 1U);  // not node 5, the largest that lies on the cylinder alone
  EXPECT_EQ(places[2].feature, inside_the_body);
  EXPECT_EQ(places[2].value_Pa, 6);
}

// What is inside, beside a higher node of the surface, is on the way to that: 79.6 +- 1.1 MPa stood there for
// what had 83.4 on the next mesh. A maximum inside is a place; so is what is beside the part left out, whose
// border may have more.
TEST(Places, InsideIsWhatDoesNotRiseToTheSurface) {
  examples::Row row(3);
  const auto inside_Pa = [&](const std::vector<meshes::SharpEdge>& edges = {}) {
    for (const auto& place :
         largest_by_feature(row.nodes, row.envelope.value_Pa, row.features, row.places(edges)))
      if (place.feature == inside_the_body) return place.value_Pa;
    return 0.0;
  };
  for (std::size_t layer = 0; layer <= 6; ++layer) row.layer(layer, 1);
  const auto places = row.places();
  for (std::size_t i = 0; i < row.nodes.n; ++i)  // x = 0 is the surface
    row.envelope.value_Pa[i] = places.feature[i] >= 0 ? 1 : 0.95;
  EXPECT_EQ(inside_Pa(), 0);
  EXPECT_EQ(inside_Pa({examples::edge_along({{0, 0, 0}, {0, 2, 0}}, 0.5)}), 0.95);
  row.envelope.value_Pa[9 * 3 + 4] = 1.1;
  EXPECT_EQ(inside_Pa(), 1.1);
}

// Stress that falls from the surface inwards over two rows of cells is nowhere a place inside: each node has
// a higher one beside it. In a bent shaft the second row of thin cells had 99 % of the surface's stress, and
// 4 % of error.
TEST(Places, InsideIsNotTheSecondRowOfCells) {
  examples::Row row(3);
  row.nodes.faces.resize(9);  // that of the first cell
  row.nodes.face_boundary_id.resize(1);
  for (std::size_t layer = 1; layer <= 6; ++layer) row.layer(layer, 1 - 0.01 * double(layer));
  for (const auto node : row.nodes.faces) row.envelope.value_Pa[std::size_t(node)] = 1;
  for (const auto& place : largest_by_feature(row.nodes, row.envelope.value_Pa, row.features, row.places()))
    EXPECT_NE(place.feature, inside_the_body) << place.value_Pa;
}

// Stress r^-1/2 beside a sharp edge that is left out up to 2.5, nodes at 2 and 3: at the border it
// is 2.5^-1/2, 9 % more than at the first node outside. A row of nodes on the border leaves nothing out.
TEST(Places, MayRiseTowardsTheBorderOfWhatIsLeftOut) {
  examples::Row row(3);
  const auto singular = [](double r) { return 1 / std::sqrt(r); };
  for (std::size_t layer = 0; layer <= 6; ++layer) row.layer(layer, singular(std::max(0.25, double(layer))));
  Judged analysis;
  analysis.responses.nodes = row.nodes;
  analysis.envelope.von_mises = row.envelope;
  analysis.mesh.features = row.features;
  const auto rise = [&](double border_m) {
    analysis.mesh.sharp_edges = {examples::edge_along({{0, 0, 0}, {0, 2, 0}}, border_m)};
    analysis.places = row.places(analysis.mesh.sharp_edges);
    for (const auto& place :
         largest_by_feature(row.nodes, row.envelope.value_Pa, row.features, analysis.places))
      if (place.feature == "fillet") return rise_to_border_Pa(analysis, place);
    return -1.0;
  };
  EXPECT_GT(rise(2.5), singular(2.5) - singular(3));
  EXPECT_LT(rise(2.5), 1.2 * (singular(2.5) - singular(3)));  // the chord of a convex function, half way
  EXPECT_NEAR(rise(2.0), 0, 2e-3);                            // what counts as on the border
  EXPECT_EQ(rise(0.0), 0);
}

// Cells of 2 beside an edge at the origin, around which 2.5 are left out: 1.25 of them. Nodes of the fillet
// lie at 3, and with less left out at 2, which is no longer beside an edge of 1.
TEST(Places, KnowHowManyCellsLieWithinWhatIsLeftOut) {
  examples::Row row(3);
  Judged analysis;
  analysis.responses.nodes = row.nodes;
  analysis.mesh.features = row.features;
  const auto cells = [&](double border_m, double at_m) {
    analysis.mesh.sharp_edges = {examples::edge_along({{0, 0, 0}, {0, 2, 0}}, border_m)};
    PlaceStress beside = place("fillet", 1, 0);
    beside.node = std::size_t(9 * at_m);
    beside.position_m = {0, 0, at_m};
    return cells_to_border(analysis, beside);
  };
  EXPECT_NEAR(cells(2.5, 3), 1.25, 1e-12);
  EXPECT_EQ(cells(1, 2), 0);
  EXPECT_EQ(cells(2.5, 4), 0) << "further than half as far again";
}

// v = v0 (1 - c h^2) on a fillet, of first order elsewhere: the change tells exactly what is missing.
TEST(PlaceHistory, AddsWhatEveryPartOfTheMeshMisses) {
  PlaceHistory history(parts_of_a_shaft);
  history.add({place("fillet a/b", 90, 30), place("seat", 50, 9)}, std::nullopt);
  EXPECT_EQ(error_of(history.judged(), "fillet a/b"), 30);
  history.add({place("fillet a/b", 96, 20), place("seat", 50, 9)},
              MeshStep{MeshPart::fillets, 2, 2, {"fillet a/b"}});
  EXPECT_EQ(error_of(history.judged(), "fillet a/b"), 20);  // two parts were never varied
  history.add({place("fillet a/b", 97, 6), place("seat", 51, 9)}, MeshStep{MeshPart::around, 1.5, 2, {}});
  EXPECT_EQ(history.by_promise("fillet a/b").front(), MeshPart::along);
  history.add({place("fillet a/b", 97.5, 6), place("seat", 52, 9)}, MeshStep{MeshPart::along, 1.5, 2, {}});
  EXPECT_NEAR(error_of(history.judged(), "fillet a/b"), 1.25 * (6 / 3.0 + 1 / 1.25 + 0.5 / 1.25), 1e-12);
  EXPECT_EQ(history.by_promise("fillet a/b").front(), MeshPart::fillets);
  // The seat is as uncertain as one mesh says until the cells of the fillets beside it were varied, too.
  EXPECT_EQ(error_of(history.judged(), "seat"), 9);
  EXPECT_EQ(history.by_promise("seat").front(), MeshPart::fillets);
  history.add({place("fillet a/b", 97.5, 6), place("seat", 52.1, 9)},
              MeshStep{MeshPart::fillets, 2, 2, {"seat"}});
  EXPECT_NEAR(error_of(history.judged(), "seat"), 1.25 * (1 / 0.5 + 1 / 0.5 + 0.1), 1e-12);
}

// Two meshes that agree by chance, or where nothing became finer, take nothing off what a mesh says of
// itself.
TEST(PlaceHistory, KeepsAFloorAndLearnsNothingWhereNothingBecameFiner) {
  PlaceHistory history({MeshPart::all});
  history.add({place("a", 90, 30), place("b", 80, 20)}, std::nullopt);
  history.add({place("a", 90, 30), place("b", 80, 20)}, MeshStep{MeshPart::all, 2, 1, {"a"}});
  EXPECT_NEAR(error_of(history.judged(), "a"), 3, 1e-12);
  EXPECT_EQ(error_of(history.judged(), "b"), 20);
  history.add({place("a", 70, 30), place("b", 60, 20)}, std::nullopt);  // the same mesh, other loads
  EXPECT_NEAR(error_of(history.judged(), "a"), 3, 1e-12);
}

// A chamber's second mesh agreed with its first at 41 MPa where finer ones have 38.
TEST(PlaceHistory, KeepsMoreOfAMeshesOwnWordAfterOneChange) {
  PlaceHistory history({MeshPart::all}, {1.0 / 3, 1.0 / 6});
  history.add({place("toe", 40.9, 15)}, std::nullopt);
  history.add({place("toe", 41.1, 12)}, MeshStep{MeshPart::all, 2, 1, {"toe"}});
  EXPECT_NEAR(error_of(history.judged(), "toe"), 4, 1e-12);
  history.add({place("toe", 41.0, 12)}, MeshStep{MeshPart::all, 2, 1, {"toe"}});
  EXPECT_NEAR(error_of(history.judged(), "toe"), 2, 1e-12);
}

// A shaft that spins had 17.7 +- 0.8 MPa near its end on its first mesh, where 19.3 is right. A place that
// became no finer has still one mesh; a second model of the same problem says what that is worth.
TEST(PlaceHistory, OneMeshAloneIsNotBelieved) {
  PlaceHistory history({MeshPart::local}, {1.0 / 3, 1.0 / 6, 0.12});
  history.add({place("end", 17.7, 0.8), place("inside", 17.6, 0.8)}, std::nullopt);
  EXPECT_NEAR(error_of(history.judged(), "end"), 0.12 * 17.7, 1e-12);
  history.add({place("end", 17.7, 0.8), place("inside", 17.9, 0.6)},
              MeshStep{MeshPart::local, 2, 1, {"inside"}});
  EXPECT_NEAR(error_of(history.judged(), "end"), 0.12 * 17.7, 1e-12);
  EXPECT_NEAR(error_of(history.judged(), "inside"), 1.25 * 0.3, 1e-12);
  history.compare_with({{place("end", 17.6, 0.05)}, 0});
  EXPECT_NEAR(error_of(history.judged(), "end"), 0.1 + 0.05, 1e-12);
}

// On the first meshes of 50 shafts what single cells tell bounded the error of every fillet of eight cells on
// the quarter, but not of the ends of shafts that spin.
TEST(PlaceHistory, OneMeshOfFineCellsIsBelieved) {
  PlaceHistory history({MeshPart::local}, {1.0 / 3, 1.0 / 6, 0.12});
  auto fine = place("fillet a/b", 104.9, 4.7), coarse = place("fillet b/c", 80, 4.7);
  fine.has_fine_cells = true;
  history.add({fine, coarse}, std::nullopt);
  EXPECT_NEAR(error_of(history.judged(), "fillet a/b"), 4.7, 1e-12);
  EXPECT_NEAR(error_of(history.judged(), "fillet b/c"), 0.12 * 80, 1e-12);
}

// The same problem solved in another way: the difference is an error of one of the two.
TEST(PlaceHistory, ASecondModelOfTheSameProblemBoundsTheErrorFromBothSides) {
  PlaceHistory history(parts_of_a_shaft);
  history.add({place("fillet a/b", 100, 30), place("seat", 79, 1), place("groove", 100, 3.8)}, std::nullopt);
  history.compare_with(
      {{place("fillet a/b", 104, 0.5), place("seat", 75, 0.5), place("groove", 104, 0.5)}, 0});
  EXPECT_NEAR(error_of(history.judged(), "fillet a/b"), 4.5, 1e-12);  // not the 30 of a single mesh
  EXPECT_NEAR(error_of(history.judged(), "seat"), 4.5, 1e-12);        // not the 1
  EXPECT_NEAR(error_of(history.judged(), "groove"), 4, 1e-12);        // not 3.8, though both errors reach
}

// Around and along were varied and moved nothing, but another model finds more: the fillets beside the place
// and the rows through the wall are what is left. However much one mesh says of its own error.
TEST(PlaceHistory, WhatIsNotExplainedIsLookedForInTheFilletsBesideAndTheRows) {
  auto parts = parts_of_a_shaft;
  parts.push_back(MeshPart::through);
  PlaceHistory history(parts);
  history.add({place("bore", 69, 9), place("end", 50, 1)}, std::nullopt);
  history.compare_with({{place("bore", 72, 0.1), place("end", 50, 0.1)}, 0});
  EXPECT_EQ(history.by_promise("bore").front(), MeshPart::around);
  history.add({place("bore", 69, 9), place("end", 50, 1)}, MeshStep{MeshPart::around, 1.5, 2, {}});
  EXPECT_EQ(history.by_promise("bore").front(), MeshPart::along);
  history.add({place("bore", 69.1, 9), place("end", 50.1, 1)}, MeshStep{MeshPart::along, 1.5, 2, {}});
  EXPECT_EQ(history.by_promise("bore")[0], MeshPart::fillets);
  EXPECT_EQ(history.by_promise("bore")[1], MeshPart::through);
  EXPECT_EQ(history.by_promise("end")[0], MeshPart::along) << "0.2 of 0.2 MPa are explained";
  EXPECT_NEAR(error_of(history.judged(), "bore"), 2.9 + 0.1, 1e-12);
}

// A model with an error of its own says only where the solid is too low.
TEST(PlaceHistory, ARoughSecondModelIsALowerBoundOnly) {
  PlaceHistory history(parts_of_a_shaft);
  history.add({place("fillet a/b", 70, 5), place("seat", 79, 9)}, std::nullopt);
  history.compare_with({{place("fillet a/b", 105, 0.5), place("seat", 75, 0.5)}, 0.06});
  EXPECT_NEAR(error_of(history.judged(), "fillet a/b"), 0.94 * 105 - 0.5 - 70, 1e-12);
  EXPECT_EQ(error_of(history.judged(), "seat"), 9);
}

// Only the fillets that may lead get more cells, and only their stress is learnt from.
TEST(Refine, FilletsThatMayLead) {
  Scene scene = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/load_table.toml");
  BodyScene body = first_meshes(scene.bodies.front()).front();
  const std::vector<PlaceStress> judged{place("fillet bearing_1/body", 30, 1),
                                        place("fillet body/bearing_2", 29, 3),
                                        place("fillet pulley_seat/bearing_1", 20, 2)};
  const auto step = refine_mesh(body, {}, judged, MeshPart::fillets);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->features, (std::vector<std::string>{"fillet bearing_1/body", "fillet body/bearing_2"}));
  EXPECT_EQ(step->ratio, 3);  // 2 cells to 6
  EXPECT_EQ(step->order, 1) << "two cells are too few for the order of a fillet's stress";
  const auto& cells = body.shaft()->mesh;
  EXPECT_EQ(cells.cells_at(0), 2);
  EXPECT_EQ(cells.cells_at(1), 6);
  EXPECT_EQ(cells.cells_at(2), 6);
}

// One direction at a time: more sectors leave the cells' length as it is, finer cells along leave the
// sectors.
TEST(Refine, AroundAndAlongByThemselves) {
  Scene scene = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/load_table.toml");
  const BodyScene before = first_meshes(scene.bodies.front()).front();
  const std::vector<PlaceStress> judged{place("seat", 30, 1)};
  BodyScene around = before, along = before;
  ASSERT_TRUE(refine_mesh(around, {}, judged, MeshPart::around));
  ASSERT_TRUE(refine_mesh(along, {}, judged, MeshPart::along));
  const auto &first = before.shaft()->mesh, &a = around.shaft()->mesh, &l = along.shaft()->mesh;
  EXPECT_EQ(a.n_sectors, 12);
  EXPECT_DOUBLE_EQ(a.axial_share / a.n_sectors, first.axial_share / first.n_sectors);
  EXPECT_EQ(a.growth, first.growth);
  EXPECT_EQ(l.n_sectors, first.n_sectors);
  EXPECT_DOUBLE_EQ(l.axial_share, first.axial_share / 1.5);
  EXPECT_DOUBLE_EQ(l.growth, first.growth / 1.5);
}

// A second model says beforehand which fillets lead; its own error makes it generous.
TEST(Refine, TheFirstMeshIsGuided) {
  Scene scene = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/load_table.toml");
  const BodyScene body = first_meshes(scene.bodies.front()).front();
  const SecondModel model{{place("fillet bearing_1/body", 30, 0.1), place("fillet body/bearing_2", 18, 0.1),
                           place("fillet pulley_seat/bearing_1", 5, 0.1)},
                          0};
  const auto mesh = guided_by(model, body).shaft()->mesh;
  EXPECT_TRUE(mesh.lean);
  EXPECT_EQ(mesh.cells_at(1), 8);
  EXPECT_EQ(mesh.cells_at(2), 4);
  EXPECT_EQ(mesh.cells_at(0), 2);
}

// Five steps without a tenth less end a search on blocks; one that lowered it does not.
TEST(Search, StandsStillAfterFiveStepsWithoutALowerError) {
  Search search;
  const auto add = [&](double error) {
    search.steps.emplace_back();
    search.steps.back().value_Pa = 100;
    search.steps.back().errors.set_numerical({"discretisation", "", error});
  };
  for (const double error : {6.0, 6.0, 5.9, 6.1, 6.0}) add(error);
  EXPECT_FALSE(stands_still(search));  // four steps
  add(5.8);
  EXPECT_TRUE(stands_still(search));
  add(5.0);
  EXPECT_FALSE(stands_still(search));
}

// A stress of 152 MPa was 130 with two cells on the fillet's quarter and 132 with four.
TEST(PlaceHistory, WantOfCellsIsKeptThoughMeshesAgree) {
  PlaceHistory history({MeshPart::local}, {0.1, 0.05});
  auto fillet = place("fillet a/b", 130, 65);
  fillet.least_error_Pa = 65;
  history.add({fillet}, std::nullopt);
  fillet = place("fillet a/b", 132, 20);
  fillet.least_error_Pa = 20;
  const MeshStep step{MeshPart::local, 2, 2, {}};
  history.add({fillet}, step);
  EXPECT_DOUBLE_EQ(error_of(history.judged(), "fillet a/b"), 20);
  history.add({place("fillet a/b", 133, 5)}, step);
  EXPECT_NEAR(error_of(history.judged(), "fillet a/b"), 1.25 * 1 / 3, 1e-12);
}

// Meshes that agree take back most of what single cells tell, and nothing of what submodels do.
TEST(PlaceHistory, WhatSubmodelsTellIsKept) {
  for (const bool is_resolved : {false, true}) {
    PlaceHistory history({MeshPart::all}, {0.3, 0.2});
    auto toe = place("toe", 100, 10);
    toe.is_resolved = is_resolved;
    history.add({toe}, std::nullopt);
    history.add({toe}, MeshStep{MeshPart::all, 2, 1, {}});
    EXPECT_DOUBLE_EQ(error_of(history.judged(), "toe"), is_resolved ? 10 : 3);
    history.add({toe}, MeshStep{MeshPart::all, 2, 1, {}});
    EXPECT_DOUBLE_EQ(error_of(history.judged(), "toe"), is_resolved ? 10 : 2);
  }
}

// A search for less than cells lose by locking refined the mesh for minutes, and met nothing.
TEST(SearchesEnd, WhereLockingIsMoreThanWasAsked) {
  Search search;
  search.tolerance = 0.01;
  search.steps.resize(1);
  GoverningStress stress;
  stress.value_Pa = 100;
  const auto reason = [&](double numerical_Pa, double locking_Pa) {
    search.met = numerical_Pa <= 1;
    stress.errors = {};
    stress.errors.set_numerical({"discretisation", "", numerical_Pa});
    stress.errors.set_model({"locking", "", locking_Pa});
    return reason_to_end(search, stress, false);
  };
  EXPECT_NE(reason(8, 50).find("Poisson's ratio"), std::string::npos) << reason(8, 50);
  EXPECT_EQ(reason(30, 50), "");  // a finer mesh lowers the sum by much
  EXPECT_EQ(reason(8, 0.5), "");  // locking is less than was asked
  EXPECT_EQ(reason(0.5, 50), "the tolerance is met");
}

// Which cells come out flat is chance: the scene's own mesh was the last one tried.
TEST(FirstMesh, OfTetrahedraABadCellLeadsToAnotherSize) {
  BodyScene body;
  meshes::Import import;
  import.geometry = "part.step";
  import.control.size_m = 0.01;
  body.shape = import;
  std::vector<double> sizes_m;
  const auto size_m = [](const BodyScene& of) {
    const auto& control = std::get<meshes::Import>(of.shape).control;
    return control.size_m * control.size_factor;
  };
  const auto mesh = [&](const BodyScene& candidate) {
    sizes_m.push_back(size_m(candidate));
    if (sizes_m.back() >= 0.0095) throw meshes::MeshRefused("a flat cell");
    return MeshedBody();
  };
  const auto first = first_mesh(body, mesh, [] { return std::numeric_limits<double>::infinity(); });
  EXPECT_LT(size_m(first.body), 0.0095);
  EXPECT_GT(size_m(first.body), 0.009);
  EXPECT_GE(sizes_m.size(), 3u);
}
