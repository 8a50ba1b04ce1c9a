// .msh files of every kind as bodies.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "meshes/imported/imported.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/imports.h"
#include "tests/unit/meshes/examples/mesh_file.h"
#include "tests/unit/meshes/examples/tetrahedra_file.h"

namespace {

using meshes::BoxSelection;
using meshes::GroupSelection;
using meshes::ImportPort;
using meshes::Port;
namespace occ = gmsh::model::occ;

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

// The flat triangles between the corners of its 12 cells around have their centre 2 % of the radius beside
// it: an even pull on the face bent a bar by 3 %.
TEST(Imported, AFaceWithCurvedEdgesIsLoadedAboutTheCentreOfItsArea) {
  const double pi = std::acos(-1.0), half_angle = pi / 3;  // of the circle, less its part beyond x = 0.5
  const auto msh = written("flattened.msh", [&] {
    gmsh::vectorpair parts;
    std::vector<gmsh::vectorpair> map;
    occ::cut({{3, occ::addCylinder(0, 0, 0, 0, 0, 1, 1)}}, {{3, occ::addBox(0.5, -2, -1, 2, 4, 3)}}, parts,
             map);
    occ::synchronize();
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 12);
    gmsh::model::mesh::generate(3);
    gmsh::model::mesh::setOrder(2);
  });
  const auto body = meshes::build_imported(
      import_of(msh, {{"end", Port::Kind::face, BoxSelection{{-2, -2, -1e-6}, {2, 2, 1e-6}}}}));
  const double area_m2 = pi - (half_angle - std::sin(2 * half_angle) / 2),
               moment_m3 = -2.0 / 3 * std::pow(std::sin(half_angle), 3);
  EXPECT_NEAR(body.ports.at(0).axis_x_m, moment_m3 / area_m2, 1e-3);
  EXPECT_NEAR(body.ports[0].axis_y_m, 0, 1e-4);
}

/// A cube of side 1 with the group "foot" of its bottom, within "outside" of all its faces; the cube itself
/// is in "part" and "steel".
void cube_in_nested_groups(double version) {
  occ::addBox(0, 0, 0, 1, 1, 1);
  occ::synchronize();
  gmsh::vectorpair faces;
  gmsh::model::getBoundary({{3, 1}}, faces, true, false);
  std::vector<int> foot, outside;
  for (const auto& face : faces) {
    double x[6];
    gmsh::model::getBoundingBox(2, face.second, x[0], x[1], x[2], x[3], x[4], x[5]);
    if (x[5] < 0.5) foot.push_back(face.second);
    outside.push_back(face.second);
  }
  const auto name = [](int dimension, const std::vector<int>& entities, const char* group) {
    gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, entities), group);
  };
  name(2, foot, "foot");
  name(2, outside, "outside");
  name(3, {1}, "part");
  name(3, {1}, "steel");
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::model::mesh::generate(3);
}

TEST(Imported, ASurfaceInTwoGroupsIsFoundByBothNames) {
  for (const double version : {2.2, 4.1}) {
    const auto msh = written("nested.msh", [&] { cube_in_nested_groups(version); });
    const auto area_of = [&](const char* group) {
      const auto read = read_tetrahedra(
          meshes::build_imported(import_of(msh, {{"chosen", Port::Kind::face, GroupSelection{group}}})));
      EXPECT_NEAR(read.volume_m3, 1, 1e-9) << version;
      EXPECT_NEAR(read.volume_of.at("part + steel"), 1, 1e-9) << version;
      return read.area_of.at("chosen");
    };
    EXPECT_NEAR(area_of("foot"), 1, 1e-9) << version;
    EXPECT_NEAR(area_of("outside"), 6, 1e-9) << version;
    expect_words(refused(import_of(msh, {{"a", Port::Kind::face, GroupSelection{"foot"}},
                                         {"b", Port::Kind::face, GroupSelection{"outside"}}})),
                 {"already belongs to port a"});
  }
}

// gmsh writes names without elements then, and the file was said to have no groups at all.
TEST(Imported, AMshOfSaveAllSaysWhyItHasNoGroups) {
  for (const double version : {2.2, 4.1}) {
    const auto msh = written("all.msh", [&] {
      cube_in_nested_groups(version);
      gmsh::option::setNumber("Mesh.SaveAll", 1);
    });
    const auto import = import_of(msh, {{"base", Port::Kind::face, GroupSelection{"foot"}}});
    if (version == 4.1)
      EXPECT_NEAR(read_tetrahedra(meshes::build_imported(import)).area_of.at("base"), 1, 1e-9);
    else
      expect_words(refused(import), {"names the group \"foot\"", "Mesh.SaveAll = 0", "version 4.1"});
  }
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
