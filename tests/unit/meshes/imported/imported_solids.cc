// STEP files that gmsh's OpenCASCADE wrote, as bodies.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "meshes/gmsh/gmsh_session.h"
#include "meshes/imported/imported.h"
#include "meshes/values/constants.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/imports.h"
#include "tests/unit/meshes/examples/mesh_file.h"
#include "tests/unit/meshes/examples/tetrahedra_file.h"

namespace {

using meshes::BoxSelection;
using meshes::CylinderSelection;
using meshes::GroupSelection;
using meshes::Import;
using meshes::ImportPort;
using meshes::Port;
namespace occ = gmsh::model::occ;
using meshes::pi;

/// In mm: diameter 40 from z = 0 to 60 with a fillet of 5 to diameter 60 up to z = 100, a hole of 10 all
/// through.
void stepped_shaft() {
  const int p[] = {occ::addPoint(5, 0, 0),   occ::addPoint(20, 0, 0),  occ::addPoint(20, 0, 55),
                   occ::addPoint(25, 0, 60), occ::addPoint(30, 0, 60), occ::addPoint(30, 0, 100),
                   occ::addPoint(5, 0, 100)};
  const int centre = occ::addPoint(25, 0, 55);
  const int wire =
      occ::addWire({occ::addLine(p[0], p[1]), occ::addLine(p[1], p[2]), occ::addCircleArc(p[2], centre, p[3]),
                    occ::addLine(p[3], p[4]), occ::addLine(p[4], p[5]), occ::addLine(p[5], p[6]),
                    occ::addLine(p[6], p[0])});
  gmsh::vectorpair parts;
  occ::revolve({{2, occ::addPlaneSurface({wire})}}, 0, 0, 0, 0, 0, 1, 2 * pi, parts);
  occ::synchronize();
}

double stepped_volume_m3() {
  // A fillet of radius f at the radius a: pi f ((a + f)^2 - (a + f) f pi/2 + 2 f^2 / 3), as in
  // shaft_volume.h.
  const double f = 5, a = 20;
  return 1e-9 * (pi * 400 * 55 + pi * f * ((a + f) * (a + f) - (a + f) * f * pi / 2 + 2 * f * f / 3) +
                 pi * 900 * 40 - pi * 25 * 100);
}

ImportPort cylinder(const std::string& name, Port::Kind kind, double radius_m, double begin_m, double end_m) {
  CylinderSelection selection;
  selection.radius_m = radius_m;
  selection.begin_m = begin_m;
  selection.end_m = end_m;
  selection.side =
      kind == Port::Kind::bore ? CylinderSelection::Side::inside : CylinderSelection::Side::outside;
  return {name, kind, selection};
}

struct SteppedStep : testing::Test {
  std::filesystem::path step = written("stepped.step", stepped_shaft);
  std::vector<ImportPort> ports = {cylinder("seat", Port::Kind::seat, 0.0201, 0, 0.055),
                                   cylinder("hole", Port::Kind::bore, 0.005, 0, 0.1),
                                   box("foot", -1e-6, 1e-6)};
};

TEST_F(SteppedStep, IsFoundMeshedAndCurved) {
  const auto body = meshes::build_imported(import_of(step, ports));
  EXPECT_EQ(int(body.cells->kind), int(meshes::CellKind::tetrahedra));
  ASSERT_EQ(body.ports.size(), 3u);
  const auto expect = [&](std::size_t p, Port::Kind kind, double radius_m, double begin_m, double end_m) {
    EXPECT_EQ(int(body.ports[p].kind), int(kind));
    EXPECT_NEAR(body.ports[p].radius_m, radius_m, 1e-9);
    EXPECT_NEAR(body.ports[p].begin_m, begin_m, 1e-9);
    EXPECT_NEAR(body.ports[p].end_m, end_m, 1e-9);
    EXPECT_NEAR(body.ports[p].axis_x_m, 0, 1e-5);
    EXPECT_NEAR(body.ports[p].axis_y_m, 0, 1e-5);
  };
  expect(0, Port::Kind::seat, 0.020, 0, 0.055);
  expect(1, Port::Kind::bore, 0.005, 0, 0.1);
  expect(2, Port::Kind::face, 0, 0, 0);
  EXPECT_EQ(body.features.size(), 7u);
  EXPECT_TRUE(body.regions.empty());
  EXPECT_TRUE(body.sharp_edges.empty());  // the fillet is none

  const auto read = read_tetrahedra(body);
  // Chords instead of parabolas would lose 6e-2.
  EXPECT_NEAR(read.volume_m3 / stepped_volume_m3(), 1, 1.2 * lost_by_parabolas(cells_around));
  EXPECT_NEAR(read.area_of.at("foot") / (1e-6 * pi * (400 - 25)), 1, 1.2 * lost_by_parabolas(cells_around));
  for (const auto& x : read.nodes_of.at("seat")) ASSERT_NEAR(std::hypot(x[0], x[1]), 0.02, 1e-9);
  for (const auto& x : read.nodes_of.at("hole")) ASSERT_NEAR(std::hypot(x[0], x[1]), 0.005, 1e-9);
  int n_on_fillet = 0;
  for (const auto& feature : body.features)
    if (feature.begin_m > 0.0549 && feature.end_m < 0.0601 && feature.end_m > feature.begin_m + 0.001)
      for (const auto& x : read.nodes_of.at(feature.name)) {
        ASSERT_NEAR(std::hypot(std::hypot(x[0], x[1]) - 0.025, x[2] - 0.055), 0.005, 1e-8);
        ++n_on_fillet;
      }
  EXPECT_GT(n_on_fillet, 100);
}

TEST_F(SteppedStep, GivesTheSameBytesTwice) {
  const auto first = msh_bytes(meshes::build_imported(import_of(step, ports)));
  msh_bytes(meshes::build_imported(import_of(step, {})));
  EXPECT_TRUE(msh_bytes(meshes::build_imported(import_of(step, ports))) == first);
}

TEST_F(SteppedStep, WrongPortsAreRefusedWithWhatThereIs) {
  const auto with = [&](const ImportPort& port) { return refused(import_of(step, {port})); };
  expect_words(with(cylinder("seat", Port::Kind::seat, 0.022, 0, 0.055)),
               {"port seat", "cylinders parallel to z are", "outside of radius 20 mm about (0, 0) mm",
                "z = 0 to 55 mm", "inside of radius 5 mm", "outside of radius 30 mm"});
  expect_words(with(cylinder("seat", Port::Kind::seat, 0.02, 0, 0.04)), {"reaches out", "0 to 55 mm", "CAD"});
  auto wrong_side = cylinder("seat", Port::Kind::seat, 0.005, 0, 0.1);
  std::get<CylinderSelection>(wrong_side.selection).side = CylinderSelection::Side::inside;
  expect_words(with(wrong_side), {"port seat", "inside", "make it a bore"});
  auto flat = box("foot", -1e-6, 1e-6);
  flat.kind = Port::Kind::seat;
  expect_words(with(flat), {"port foot", "no cylinder parallel to z"});
  expect_words(with(box("foot", 0.01, 0.02)), {"port foot", "no surface lies in its box", "surface 1"});
  expect_words(with({"foot", Port::Kind::face, GroupSelection{"pads"}}), {"\"pads\"", "STEP carries none"});
  expect_words(refused(import_of(step, {ports[0], box("all", -1, 1)})),
               {"port all", "already belongs to port seat"});
  expect_words(refused(import_of(step, {ports[0], ports[0]})), {"two ports are called 'seat'"});
}

TEST(Imported, WrongFilesAreRefused) {
  expect_words(refused(import_of("/nonexistent/part.step", {})), {"/nonexistent/part.step", "no file"});
  expect_words(refused(import_of("/nonexistent/part.iges", {})), {".step, .stp or .msh"});
  const auto broken = temporary_msh("x").parent_path() / "broken.step";
  std::ofstream(broken) << "ISO-10303-21;\nHEADER;\n";
  expect_words(refused(import_of(broken, {})), {"broken.step"});
  expect_words(refused(import_of(written("shell.step",
                                         [] {
                                           occ::addRectangle(0, 0, 0, 10, 10);
                                           occ::synchronize();
                                         }),
                                 {})),
               {"shell.step", "no solid"});
  expect_words(refused(import_of(written("apart.step",
                                         [] {
                                           occ::addBox(0, 0, 0, 10, 10, 10);
                                           occ::addBox(20, 0, 0, 10, 10, 10);
                                           occ::synchronize();
                                         }),
                                 {})),
               {"apart.step", "2 parts that do not touch"});
  auto import = import_of(written("box.step",
                                  [] {
                                    occ::addBox(0, 0, 0, 10, 10, 10);
                                    occ::synchronize();
                                  }),
                          {});
  import.control.min_scaled_jacobian = 0.95;
  expect_words(refused(import), {"smallest scaled Jacobian", "wanted 0.95", "mm"});
  import.scale_to_m = -1;
  expect_words(refused(import), {"scale_to_m = -1"});
}

// Red without check_step_unit: the box was 25.4 times as long as drawn.
TEST(Imported, AStepFileInInchesIsReadAsItStatesAndNotScaledOnceMore) {
  const auto step = written("inch.step", [] {
    occ::addBox(0, 0, 0, 1, 1, 1);
    occ::synchronize();
  });
  std::ifstream in(step);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::string mm = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );";
  ASSERT_NE(text.find(mm), std::string::npos);
  text.replace(text.find(mm), mm.size(),
               "( CONVERSION_BASED_UNIT('INCH',#902)\nLENGTH_UNIT() NAMED_UNIT(#901) );\n#900 = " + mm +
                   "\n#901 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);"
                   "\n#902 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#900);");
  std::ofstream(step, std::ios::trunc) << text;
  auto import = import_of(step, {});
  const auto body = meshes::build_imported(import);
  const double inch_m = 0.0254;
  EXPECT_NEAR(read_tetrahedra(body).volume_m3, inch_m * inch_m * inch_m, 1e-12);  // rounding of the file
  import.scale_to_m = inch_m;
  expect_words(refused(import), {"inch.step", "states its own length unit", "'INCH'", "once more", "1 mm"});
  import.scale_to_m = 1e-3;
  EXPECT_NO_THROW(meshes::build_imported(import));
}

// Nearly all cells are flat: moving their nodes went on until the process was ended, and gmsh was blamed for
// it.
TEST(Imported, ThinSheetInLargeCellsIsRefusedForThem) {
  const auto file = written("sheet.step", [] {
    gmsh::vectorpair parts;
    std::vector<gmsh::vectorpair> map;
    occ::cut({{3, occ::addBox(-50, 0, 0, 100, 0.5, 200)}}, {{3, occ::addCylinder(0, -1, 100, 0, 3, 0, 10)}},
             parts, map);
    occ::synchronize();
  });
  try {
    meshes::build_imported(import_of(file, {box("low", -0.001, 0.001), box("high", 0.199, 0.201)}));
    FAIL() << "accepted";
  } catch (const meshes::MeshRefused& error) {
    EXPECT_NE(std::string(error.what()).find("mesh finer there"), std::string::npos) << error.what();
  }
}

TEST(Imported, SolidsThatTouchAreOneBodyAndItsCornersAreSharp) {
  const auto step = written("l.step", [] {
    occ::addBox(0, 0, 0, 30, 10, 10);
    occ::addBox(0, 10, 0, 10, 20, 10);
    occ::synchronize();
  });
  const auto body = meshes::build_imported(import_of(step, {}));
  EXPECT_NEAR(read_tetrahedra(body).volume_m3, 5e-6, 1e-14);
  ASSERT_EQ(body.sharp_edges.size(), 1u);  // the inner corner, 10 mm long at (10, 10)
  double length_m = 0;
  for (const auto& piece : body.sharp_edges[0].pieces) {
    length_m += std::abs(piece[1][2] - piece[0][2]);
    for (const auto& end : piece) EXPECT_NEAR(std::hypot(end[0] - 0.01, end[1] - 0.01), 0, 1e-9);
  }
  EXPECT_NEAR(length_m, 0.01, 1e-9);
  // Second moment of both boxes about (11, 11, 5), their common centre.
  const double second_mm5 =
      3000 * ((900 + 100 + 100) / 12. + 16 + 36) + 2000 * ((100 + 400 + 100) / 12. + 36 + 81);
  EXPECT_NEAR(body.sharp_edges[0].distance_m, 0.01 * 1e-3 * std::sqrt(12 * second_mm5 / 5000), 1e-9);
}

// By the box around it a part turned by 45 degrees had another distance, and another stress at its border.
TEST(Imported, WhatIsLeftOutAroundEdgesTurnsWithThePart) {
  for (const bool is_mesh : {false, true}) {
    std::vector<double> distance_m;
    for (const double angle : {0.0, pi / 4}) {
      const auto file = written(is_mesh ? "l.msh" : "l.step", [&] {
        gmsh::vectorpair parts;
        std::vector<gmsh::vectorpair> map;
        occ::fuse({{3, occ::addBox(0, 0, 0, 30, 10, 10)}}, {{3, occ::addBox(0, 10, 0, 10, 20, 10)}}, parts,
                  map);
        occ::rotate(parts, 0, 0, 0, 1, 1, 0, angle);
        occ::rotate(parts, 0, 0, 0, 0, 0, 1, angle);
        occ::synchronize();
        if (is_mesh) gmsh::model::mesh::generate(3);
      });
      auto import = import_of(file, {});
      import.scale_to_m = 1e-3;
      const auto body = meshes::build_imported(import);
      ASSERT_EQ(body.sharp_edges.size(), 1u);
      distance_m.push_back(body.sharp_edges[0].distance_m);
    }
    EXPECT_NEAR(distance_m[1] / distance_m[0], 1, 1e-9) << (is_mesh ? ".msh" : "STEP");
  }
}

// 1 % of the diagonal was more than the rod's radius: all that lay beside the collar was left out with its
// edges.
TEST(Imported, OfSlenderPartsVolumeOverSurfaceIsLeftOutAroundEdges) {
  constexpr double length_mm = 1200, radius_mm = 10, collar_mm = 8, collar_radius_mm = 12;
  const auto step = written("rod.step", [] {
    gmsh::vectorpair rod;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, occ::addCylinder(0, 0, 0, 0, 0, length_mm, radius_mm)}},
              {{3, occ::addCylinder(0, 0, 600, 0, 0, collar_mm, collar_radius_mm)}}, rod, map);
    occ::synchronize();
  });
  auto import = import_of(step, {});
  import.control.cells_per_circle = 16;
  const auto body = meshes::build_imported(import);
  const double ring_mm2 = collar_radius_mm * collar_radius_mm - radius_mm * radius_mm,
               volume_mm3 = pi * (radius_mm * radius_mm * length_mm + ring_mm2 * collar_mm),
               area_mm2 = 2 * pi *
                          (radius_mm * (length_mm - collar_mm) + collar_radius_mm * collar_mm +
                           radius_mm * radius_mm + ring_mm2);
  ASSERT_EQ(body.sharp_edges.size(), 2u);
  for (const auto& edge : body.sharp_edges)
    EXPECT_NEAR(edge.distance_m, 1e-3 * volume_mm3 / area_mm2, 1e-9);  // 5 mm; of the CAD, not of the mesh
}

// A pull through the middle of the T's extent in z, not its centre of area, bent it: 207 MPa instead of 100.
// A disc's centre by the mesh was 2e-5 m off, so that a pull on both ends of a bar did not close.
TEST(Imported, AFaceIsLoadedAboutTheCentreOfItsArea) {
  const auto step = written("tee.step", [] {
    gmsh::vectorpair tee;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, occ::addBox(0, -20, 0, 60, 40, 10)}}, {{3, occ::addBox(0, -5, 10, 60, 10, 40)}}, tee, map);
    const int disc = occ::addCylinder(60, 0, 20, 30, 0, 0, 15);
    occ::fuse(tee, {{3, disc}}, tee, map);
    occ::synchronize();
  });
  const auto face = [](const std::string& name, double x_m) {
    return ImportPort{name, Port::Kind::face, BoxSelection{{x_m - 1e-6, -1, -1}, {x_m + 1e-6, 1, 1}}};
  };
  const auto body = meshes::build_imported(import_of(step, {face("tee", 0), face("disc", 0.09)}));
  ASSERT_EQ(body.ports.size(), 2u);
  const double of_tee_m = 1e-3 * (400 * 5 + 400 * 30) / 800.0;
  for (const auto& [port, x_m, z_m] :
       {std::tuple(body.ports[0], 0.0, of_tee_m), {body.ports[1], 0.09, 0.02}}) {
    EXPECT_NEAR(port.axis_x_m, x_m, 1e-12) << port.name;
    EXPECT_NEAR(port.axis_y_m, 0, 1e-12) << port.name;
    EXPECT_NEAR((port.begin_m + port.end_m) / 2, z_m, 1e-12) << port.name;
  }
}

/// In mm: a link 100 x 40 x 8 with holes of 12 at both ends, along y a rounding of 5 and a fillet of 4 under
/// a rib; exported by its own surfaces or by B-splines, which a scaling makes of all of them.
void link(bool of_splines) {
  const double height = of_splines ? 0.5 : 1;
  gmsh::vectorpair whole, part, filleted;
  std::vector<gmsh::vectorpair> map;
  occ::fuse({{3, occ::addBox(-50, -20, 0, 100, 40, 8 * height)}},
            {{3, occ::addBox(-10, -20, 8 * height, 20, 40, 12 * height)}}, whole, map);
  gmsh::vectorpair holes;
  for (const double x : {-35, 35}) holes.push_back({3, occ::addCylinder(x, 0, -1, 0, 0, 12, 6)});
  occ::cut(whole, holes, part, map);
  if (of_splines) occ::dilate(part, 0, 0, 0, 1, 1, 1 / height);
  occ::synchronize();
  gmsh::vectorpair edges;
  gmsh::model::getEntitiesInBoundingBox(9.9, -21, 7.9, 10.1, 21, 8.1, edges, 1);
  if (!of_splines) occ::fillet({part[0].second}, {edges[0].second}, {4}, filleted);
  occ::synchronize();
}

ImportPort eye(const std::string& name, double x_m) {
  CylinderSelection selection;
  selection.axis_x_m = x_m;
  selection.radius_m = 0.006;
  selection.begin_m = -0.001;
  selection.end_m = 0.01;
  selection.side = CylinderSelection::Side::inside;
  return {name, Port::Kind::face, selection};
}

// OpenCASCADE's area of a hole that is a B-spline had its centre 7 um beside the axis.
TEST(Imported, HolesThatAreSplinesAreLoadedAboutTheirCentre) {
  for (const bool of_splines : {false, true}) {
    const auto step = written(of_splines ? "splines.step" : "link.step", [&] { link(of_splines); });
    const auto body = meshes::build_imported(import_of(step, {eye("left", -0.035), eye("right", 0.035)}));
    for (const auto& [port, x_m] : {std::pair(body.ports.at(0), -0.035), {body.ports.at(1), 0.035}}) {
      EXPECT_NEAR(port.axis_x_m, x_m, 1e-12) << port.name << of_splines;
      EXPECT_NEAR(port.axis_y_m, 0, 1e-12) << port.name << of_splines;
      EXPECT_NEAR(port.begin_m, 0.004, 1e-12) << port.name << of_splines;
    }
  }
}

TEST(Imported, SurfacesAreNamedByTheirShape) {
  for (const bool of_splines : {false, true}) {
    const auto step = written(of_splines ? "splines.step" : "link.step", [&] { link(of_splines); });
    const auto body = meshes::build_imported(import_of(step, {}));
    std::string names;
    for (const auto& feature : body.features) names += feature.name + "\n";
    std::vector<std::string> wanted = {"hole d 12 mm (surface ", "plane z = 0 mm (surface ",
                                       "plane z = 20 mm (surface ", "plane x = -50 mm (surface "};
    if (!of_splines) wanted.push_back("fillet r 4 mm (surface ");
    expect_words(names, wanted);
  }
}

// Cells as long as the faces beside it were as good as flat on a chamfer of a hair, and no coarser or finer
// size of the whole mesh helped.
TEST(Imported, ANarrowChamferIsMeshed) {
  for (const double chamfer_mm : {0.05, 0.0002}) {
    const auto step = written("chamfer.step", [&] {
      const int block = occ::addBox(0, 0, 0, 20, 12, 8);
      occ::synchronize();
      gmsh::vectorpair edges, faces, out;
      gmsh::model::getEntitiesInBoundingBox(19.9, -1, 7.9, 20.1, 13, 8.1, edges, 1);
      gmsh::model::getEntitiesInBoundingBox(-1, -1, 7.9, 21, 13, 8.1, faces, 2);
      occ::chamfer({block}, {edges.at(0).second}, {faces.at(0).second}, {chamfer_mm}, out);
      occ::synchronize();
    });
    auto import = import_of(step, {box("foot", -1e-6, 1e-6)});
    import.control.size_m = 0.004;
    if (chamfer_mm < 1e-3) {
      expect_words(refusal_of([&] { meshes::build_imported(import); }),
                   {"surface ", "wide", "too narrow", "CAD"});
      continue;
    }
    const auto body = meshes::build_imported(import);
    EXPECT_GT(body.quality.min_scaled_jacobian, 0.05) << chamfer_mm;
    EXPECT_LT(body.cells->n_cells(), 20000u) << chamfer_mm;
  }
}

// 145 m off the origin a pipe with a branch had other cells than at it, and a search for finer ones ended at
// a cell that was nearly flat.
TEST(Imported, APartFarFromTheOriginIsMeshedAsAtIt) {
  const std::array<double, 3> at_m{-89.000123, 77.7777, 88.8888};
  const auto build = [&](bool far) {
    const auto step = written(far ? "far.step" : "near.step", [&] {
      gmsh::vectorpair outside, pipe;
      std::vector<gmsh::vectorpair> map;
      occ::fuse({{3, occ::addCylinder(0, 0, -100, 0, 0, 200, 40)}},
                {{3, occ::addCylinder(0, 0, 0, 90, 0, 0, 15)}}, outside, map);
      occ::cut(
          outside,
          {{3, occ::addCylinder(0, 0, -101, 0, 0, 202, 35)}, {3, occ::addCylinder(0, 0, 0, 91, 0, 0, 12)}},
          pipe, map);
      if (far) occ::translate(pipe, 1e3 * at_m[0], 1e3 * at_m[1], 1e3 * at_m[2]);
      occ::synchronize();
    });
    const double z_m = (far ? at_m[2] : 0) - 0.1;
    auto import = import_of(
        step, {{"foot", Port::Kind::face, BoxSelection{{-100, -100, z_m - 1e-4}, {100, 100, z_m + 1e-4}}}});
    import.control.cells_per_circle = 11;
    import.control.size_factor = 1.5;
    return meshes::build_imported(import);
  };
  const auto near = build(false), far = build(true);
  EXPECT_EQ(far.cells->n_cells(), near.cells->n_cells());
  ASSERT_EQ(far.cells->points.size(), near.cells->points.size());
  EXPECT_NEAR(far.ports.at(0).axis_x_m, near.ports.at(0).axis_x_m + at_m[0], 1e-9);
  EXPECT_NEAR(far.ports[0].begin_m, near.ports[0].begin_m + at_m[2], 1e-9);
  for (int d = 0; d < 3; ++d) {
    double apart_m = 0;
    for (std::size_t i = 0; i < far.cells->points.size(); ++i)
      apart_m += (far.cells->points[i][d] - near.cells->points[i][d]) / double(far.cells->points.size());
    EXPECT_NEAR(apart_m, at_m[d], 1e-4) << "inner nodes differ by rounding";
  }
}

}  // namespace
