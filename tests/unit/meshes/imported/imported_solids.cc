// STEP files that gmsh's OpenCASCADE wrote, and .msh files of every kind, as bodies.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <tuple>

#include "meshes/gmsh/gmsh_session.h"
#include "meshes/imported/imported.h"
#include "meshes/values/constants.h"
#include "tests/unit/meshes/examples/example_shafts.h"
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
constexpr int cells_around = 10;  // cells: coarse, for speed

/// Runs a construction in a session of its own and writes what it left.
std::filesystem::path written(const std::string& name, const std::function<void()>& construct) {
  auto file = temporary_msh("sample").parent_path() / name;
  meshes::with_gmsh("making a sample", [&] {
    gmsh::model::add("sample");
    construct();
    gmsh::write(file.string());
  });
  return file;
}

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

ImportPort box(const std::string& name, double low_z_m, double high_z_m) {
  return {name, Port::Kind::face, BoxSelection{{-1, -1, low_z_m}, {1, 1, high_z_m}}};
}

Import import_of(const std::filesystem::path& geometry, const std::vector<ImportPort>& ports) {
  Import import;
  import.geometry = geometry;
  import.ports = ports;
  import.control.cells_per_circle = cells_around;
  return import;
}

std::string refused(Import import) {
  import.control.smallest_size_m = 0.006;  // a few hundred cells
  return refusal_of([&] { meshes::build_imported(import); });
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

/// Two boxes that share a face, groups "low" and "high", their bottom "foot"; order and version as asked for.
void grouped_boxes(int order, double version, bool hexahedra) {
  occ::addBox(0, 0, 0, 1, 1, 1);
  occ::addBox(0, 0, 1, 1, 1, 1);
  gmsh::vectorpair parts, faces;
  std::vector<gmsh::vectorpair> map;
  occ::fragment({{3, 1}}, {{3, 2}}, parts, map);
  occ::synchronize();
  for (const auto& part : parts) {
    double x[6];
    gmsh::model::getBoundingBox(3, part.second, x[0], x[1], x[2], x[3], x[4], x[5]);
    const int tag = gmsh::model::addPhysicalGroup(3, {part.second}, x[5] < 1.5 ? 10 : 11);
    gmsh::model::setPhysicalName(3, tag, x[5] < 1.5 ? "low" : "high");
  }
  gmsh::model::getBoundary(parts, faces, true, false);
  std::vector<int> foot, rest;
  for (const auto& face : faces) {
    double x[6];
    gmsh::model::getBoundingBox(2, face.second, x[0], x[1], x[2], x[3], x[4], x[5]);
    (x[5] < 0.5 ? foot : rest).push_back(face.second);
  }
  gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, foot, 20), "foot");
  gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, rest, 21), "sides");
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  if (hexahedra) gmsh::model::mesh::setTransfiniteAutomatic();
  gmsh::model::mesh::generate(3);
  if (order == 2) gmsh::model::mesh::setOrder(2);
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

TEST(Imported, AFaceOfHexahedraIsLoadedAboutTheCentreOfItsArea) {
  const auto msh = written("wedge.msh", [] {  // one cell: 2 high at x = 0, 1 at x = 3
    const int p[] = {occ::addPoint(0, 0, 0), occ::addPoint(3, 0, 0), occ::addPoint(3, 0, 1),
                     occ::addPoint(0, 0, 2)};
    const int wire = occ::addWire({occ::addLine(p[0], p[1]), occ::addLine(p[1], p[2]),
                                   occ::addLine(p[2], p[3]), occ::addLine(p[3], p[0])});
    gmsh::vectorpair parts;
    occ::extrude({{2, occ::addPlaneSurface({wire})}}, 0, 1, 0, parts, {1}, {}, true);
    occ::synchronize();
    gmsh::option::setNumber("Mesh.MeshSizeMin", 10);
    gmsh::model::mesh::setTransfiniteAutomatic();
    gmsh::model::mesh::generate(3);
  });
  const auto body = meshes::build_imported(
      import_of(msh, {{"end", Port::Kind::face, BoxSelection{{-1, -1e-6, -1}, {9, 1e-6, 9}}}}));
  ASSERT_EQ(int(body.cells->kind), int(meshes::CellKind::hexahedra));
  ASSERT_EQ(body.ports.size(), 1u);
  EXPECT_NEAR(body.ports[0].axis_x_m, (3 * 1.5 + 1.5 * 1) / 4.5, 1e-12);
  EXPECT_NEAR(body.ports[0].begin_m, (3 * 0.5 + 1.5 * 4 / 3) / 4.5, 1e-12);
}

TEST(Imported, AMshWithGroupsGoesInAndOut) {
  for (const int order : {1, 2})
    for (const double version : {2.2, 4.1}) {
      const auto msh = written("grouped.msh", [&] { grouped_boxes(order, version, false); });
      const auto body =
          meshes::build_imported(import_of(msh, {{"base", Port::Kind::face, GroupSelection{"foot"}}}));
      const auto read = read_tetrahedra(body);
      EXPECT_NEAR(read.volume_of.at("low"), 1, 1e-9);
      EXPECT_NEAR(read.volume_of.at("high"), 1, 1e-9);
      EXPECT_NEAR(read.area_of.at("base"), 1, 1e-9);
      EXPECT_NEAR(read.area_of.at("sides"), 9, 1e-9);  // the face between the boxes is no boundary
      ASSERT_EQ(body.regions.size(), 2u);
      EXPECT_EQ(body.regions[0].volume_ids.size(), 1u);
      ASSERT_EQ(body.ports.size(), 1u);
      EXPECT_NEAR(body.ports[0].axis_x_m, 0.5, 1e-12);
      expect_words(refused(import_of(msh, {{"base", Port::Kind::face, GroupSelection{"feet"}}})),
                   {"\"feet\"", "groups are", "foot", "sides"});
      auto in_mm = import_of(msh, {});
      in_mm.scale_to_m = 1e-3;
      EXPECT_NEAR(read_tetrahedra(meshes::build_imported(in_mm)).volume_m3, 2e-9, 1e-17);
    }
}

/// A quarter of a tube of radii 1 and 2, `n_around` hexahedra around, of 20 or 27 nodes.
void quarter_of_a_tube(int n_around, bool of_20_nodes) {
  const int centre = occ::addPoint(0, 0, 0);
  const int p[] = {occ::addPoint(1, 0, 0), occ::addPoint(2, 0, 0), occ::addPoint(0, 2, 0),
                   occ::addPoint(0, 1, 0)};
  const int wire = occ::addWire({occ::addLine(p[0], p[1]), occ::addCircleArc(p[1], centre, p[2]),
                                 occ::addLine(p[2], p[3]), occ::addCircleArc(p[3], centre, p[0])});
  gmsh::vectorpair parts, curves;
  occ::extrude({{2, occ::addPlaneSurface({wire})}}, 0, 0, 1, parts, {1}, {}, true);
  occ::synchronize();
  gmsh::model::getEntities(curves, 1);
  for (const auto& curve : curves) {
    std::string type;
    gmsh::model::getType(1, curve.second, type);
    gmsh::model::mesh::setTransfiniteCurve(curve.second, type == "Circle" ? n_around + 1 : 2);
  }
  gmsh::model::mesh::setTransfiniteSurface(1);
  gmsh::model::mesh::setRecombine(2, 1);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", of_20_nodes ? 1 : 0);
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(2);
}

// Straight cells in their place lost 10 % of a bar's section with 8 of them around, which no error told of.
TEST(Imported, HexahedraThatAreTooCurvedToBecomeStraightAreRefused) {
  for (const bool of_20_nodes : {false, true}) {
    const auto coarse = written("tube.msh", [&] { quarter_of_a_tube(4, of_20_nodes); });
    expect_words(refused(import_of(coarse, {})),
                 {"tube.msh", "second order are curved by up to 0.0492", "taken for straight", "tetrahedra"});
    const auto fine = written("tube.msh", [&] { quarter_of_a_tube(16, of_20_nodes); });
    EXPECT_EQ(meshes::build_imported(import_of(fine, {})).cells->n_cells(), 16u);
  }
}

// A plate of 300 mm whose mesh gmsh had written in mm was 300 m long, and its stress a millionth.
TEST(Imported, AMshTooLargeForMetresHasToSayItsUnit) {
  const auto msh = written("large.msh", [] {
    occ::addBox(0, 0, 0, 300, 40, 40);
    occ::synchronize();
    gmsh::option::setNumber("Mesh.MeshSizeMin", 40);
    gmsh::model::mesh::generate(3);
  });
  auto import = import_of(msh, {});
  expect_words(refused(import),
               {"large.msh", "305 m from corner to corner", "length_unit", "\"1 mm\"", "\"1 m\""});
  for (const double unit_m : {1e-3, 1.0}) {
    import.scale_to_m = unit_m;
    EXPECT_NEAR(
        read_tetrahedra(meshes::build_imported(import)).volume_m3 / (300 * 40 * 40 * std::pow(unit_m, 3)), 1,
        1e-9);
  }
}

// "Make the box larger" was no remedy: all of the surface was one piece.
TEST(Imported, AMshWithoutCellsOnItsSurfacesIsToldSo) {
  const auto msh = written("volume.msh", [] {
    occ::addBox(0, 0, 0, 1, 1, 1);
    occ::synchronize();
    gmsh::model::addPhysicalGroup(3, {1});
    gmsh::model::mesh::generate(3);
  });
  EXPECT_NO_THROW(meshes::build_imported(import_of(msh, {})));
  for (const auto& port :
       {box("foot", -1e-6, 1e-6), ImportPort{"foot", Port::Kind::face, GroupSelection{"foot"}}})
    expect_words(refused(import_of(msh, {port})), {"volume.msh", "port foot", "no cells on its surfaces"});
}

TEST(Imported, GroupsWithNamesThatTablesCannotCarryAreRefused) {
  const auto msh = written("grouped.msh", [&] { grouped_boxes(1, 4.1, false); });
  std::ifstream in(msh);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (const char* name : {"=1+1", "a\tb", "@x"}) {
    std::string renamed = text;
    renamed.replace(renamed.find("\"sides\""), 7, "\"" + std::string(name) + "\"");
    std::ofstream(msh, std::ios::trunc) << renamed;
    expect_words(refused(import_of(msh, {})), {"grouped.msh", "physical group 21", "rename it"});
  }
}

/// Two by two cubes; the middle nodes of one side are there twice, so that the cells above and below them are
/// not joined by their face.
std::filesystem::path cubes_with_a_slit(bool slit) {
  const auto file = temporary_msh("slit");
  std::ofstream out(file);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << (slit ? 20 : 18) << '\n';
  const auto node = [](int x, int y, int z) { return 1 + x + 3 * y + 6 * z; };
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) out << node(x, y, z) << ' ' << x << ' ' << y << ' ' << z << '\n';
  if (slit) out << "19 2 0 1\n20 2 1 1\n";
  out << "$EndNodes\n$Elements\n4\n";
  int n = 0;
  for (int z = 0; z < 2; ++z)
    for (int x = 0; x < 2; ++x) {
      out << ++n << " 5 2 1 1";
      for (int top = 0; top < 2; ++top)
        for (const auto& [dx, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
          const bool twice = slit && z == 1 && top == 0 && x + dx == 2;
          out << ' ' << (twice ? 19 + y : node(x + dx, y, z + top));
        }
      out << '\n';
    }
  out << "$EndElements\n";
  return file;
}

// A part of which two faces lie on one another without sharing nodes was solved with a slit.
TEST(Imported, CellsThatTouchWithoutSharingNodesAreRefused) {
  EXPECT_NO_THROW(meshes::build_imported(import_of(cubes_with_a_slit(false), {})));
  expect_words(refused(import_of(cubes_with_a_slit(true), {})),
               {"slit", "1 faces of its cells lie on others", "(1500, 500, 1000) mm", "Coherence Mesh"});
}

TEST(Imported, HexahedraPassThrough) {
  const auto msh = written("hexahedra.msh", [] { grouped_boxes(1, 4.1, true); });
  const auto probe = refusal_of([&] { read_tetrahedra(msh); });
  ASSERT_NE(probe.find("another type"), std::string::npos) << "gmsh made no hexahedra: " << probe;
  const auto body =
      meshes::build_imported(import_of(msh, {{"base", Port::Kind::face, GroupSelection{"foot"}}}));
  EXPECT_EQ(int(body.cells->kind), int(meshes::CellKind::hexahedra));
  EXPECT_EQ(body.regions.size(), 2u);
  EXPECT_NEAR(body.quality.min_scaled_jacobian, 1, 1e-9);
  EXPECT_EQ(body.features.size(), 2u);
}

}  // namespace
