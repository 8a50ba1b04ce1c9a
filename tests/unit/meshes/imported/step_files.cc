/// STEP files as other programs write them, and what is told of them before they are meshed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "tests/unit/meshes/examples/imports.h"

namespace {

std::filesystem::path block() {
  static const auto file = written("block.step", [] {
    gmsh::vectorpair result;
    std::vector<gmsh::vectorpair> map;
    gmsh::model::occ::cut({{3, gmsh::model::occ::addBox(0, 0, 0, 40, 30, 20)}},
                          {{3, gmsh::model::occ::addCylinder(10, 15, 0, 0, 0, 20, 5)}}, result, map);
    gmsh::model::occ::synchronize();
  });
  return file;
}

std::string text_of_block() {
  std::ifstream in(block(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All of them, for one.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

meshes::ImportPort cylinder_port(double x_m, double radius_m, double begin_m, double end_m) {
  meshes::CylinderSelection cylinder;
  cylinder.axis_x_m = x_m;
  cylinder.axis_y_m = 0.015;
  cylinder.radius_m = radius_m;
  cylinder.begin_m = begin_m;
  cylinder.end_m = end_m;
  cylinder.side = meshes::CylinderSelection::Side::inside;
  return {"hole", meshes::Port::Kind::bore, cylinder};
}

}  // namespace

// OpenCASCADE takes neither a mark of the order of bytes nor anything between a keyword and its semicolon,
// which ISO 10303-21 permits. Turns red: the file as it is.
TEST(StepFiles, AreReadAsOtherProgramsWriteThem) {
  const auto text = text_of_block();
  const auto volume_m3 = meshes::outline_imported(import_of(block(), {})).volume_m3;
  const auto other = block().parent_path() / "other.step";
  for (const auto& variant : {replaced(text, "\n", "\r\n"), "\xEF\xBB\xBF" + text, text + "\x1a",
                              replaced(text, "ENDSEC;", "ENDSEC ;"),
                              replaced(text, "END-ISO-10303-21;", "END-ISO-10303-21 /* the end; of it */ ;"),
                              replaced(replaced(text, "DATA;", "DATA/* here */;"), "HEADER;", "HEADER\n;"),
                              "\xEF\xBB\xBF" + replaced(text, "\n", "\r\n") + "\x1a"}) {
    std::ofstream(other, std::ios::binary) << variant;
    EXPECT_EQ(meshes::outline_imported(import_of(other, {})).volume_m3, volume_m3) << variant.substr(0, 40);
  }
}

TEST(StepFiles, TellOfPortsWithoutASurface) {
  const auto outlined = [](const meshes::ImportPort& port) {
    return refusal_of([&] { meshes::outline_imported(import_of(block(), {port})); });
  };
  EXPECT_EQ(outlined(box("top", 0.0199, 0.0201)), "accepted");
  expect_words(outlined(box("beside", 0.021, 0.030)), {"port beside", "no surface", "in its box", "ports"});
  EXPECT_EQ(outlined(cylinder_port(0.010, 0.005, 0, 0.020)), "accepted");
  expect_words(outlined(cylinder_port(0.010, 0.006, 0, 0.020)), {"port hole", "on its cylinder"});
  expect_words(outlined(cylinder_port(0.012, 0.005, 0, 0.020)), {"port hole", "on its cylinder"});
  expect_words(outlined(cylinder_port(0.010, 0.005, 0.030, 0.040)), {"port hole", "on its cylinder"});
}

// A needle was told only when it was meshed.
TEST(StepFiles, TellOfNeedles) {
  const auto needle = written("needle.step", [] {
    gmsh::model::occ::addCone(0, 0, 0, 0, 0, 60, 10, 0);
    gmsh::model::occ::synchronize();
  });
  expect_words(refusal_of([&] { meshes::outline_imported(import_of(needle, {})); }),
               {"comes to a tip", "too slender", "cut the tip off flat"});
}

// What a needle of B-splines is refused with helps. The CAD kernel takes its volume for 1 % more than it is.
TEST(StepFiles, NeedlesThatAreCutOffAreMeshed) {
  const double base = 10, end = 0.5, height = 38, rod = 20;  // mm
  const auto blunt = written("blunt.step", [&] {
    namespace occ = gmsh::model::occ;
    gmsh::vectorpair result;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, occ::addCylinder(0, 0, -rod / 2, 0, 0, rod / 2, base)}},
              {{3, occ::addCone(0, 0, 0, 0, 0, height / 2, base, end)}}, result, map);
    occ::dilate(result, 0, 0, 0, 1, 1, 2);  // which makes splines of all surfaces
    occ::synchronize();
  });
  const double exact_m3 =
      M_PI * (base * base * rod + height / 3 * (base * base + base * end + end * end)) * 1e-9;
  auto import = import_of(blunt, {});
  import.control.cells_per_circle = 16;  // as by default: parabolas around them lose 5e-5
  EXPECT_NEAR(read_tetrahedra(meshes::build_imported(import)).volume_m3, exact_m3, 1e-3 * exact_m3);
}
