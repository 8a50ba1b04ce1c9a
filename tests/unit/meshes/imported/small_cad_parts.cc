// Small parts of every kind are meshed as they are, or refused for what they are.
#include <gmsh.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshes/values/refused.h"
#include "tests/unit/meshes/examples/imports.h"
#include "tests/unit/meshes/examples/tetrahedra_file.h"
#include "tests/unit/meshes/imported/cad_parts.h"

namespace {

double cpu_seconds_with_children() {
  double seconds = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    ::getrusage(who, &used);
    for (const auto& time : {used.ru_utime, used.ru_stime})
      seconds += double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  }
  return seconds;
}

struct DrawnPart {
  std::filesystem::path file;
  double volume_m3 = 0;  ///< by OpenCASCADE
};

DrawnPart drawn(const CadPart& part) {
  DrawnPart result;
  std::string name = part.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == ','; }, '_');
  result.file = written(name + ".step", [&] {
    part.draw();
    gmsh::model::occ::synchronize();
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    for (const auto& [dimension, tag] : volumes) {
      double volume_mm3 = 0;
      gmsh::model::occ::getMass(dimension, tag, volume_mm3);
      result.volume_m3 += 1e-9 * volume_mm3;
    }
  });
  return result;
}

meshes::Import as_it_is(const std::filesystem::path& file) {
  meshes::Import import;
  import.geometry = file;
  return import;
}

const CadPart& part_called(const std::string& name) {
  for (const auto& part : cad_parts())
    if (part.name == name) return part;
  throw std::logic_error("no part " + name);
}

int n_tips(const meshes::BodyMesh& body) {
  return int(std::count_if(body.sharp_edges.begin(), body.sharp_edges.end(),
                           [](const auto& edge) { return edge.name.rfind("tip of ", 0) == 0; }));
}

double largest_off_m(const meshes::BodyMesh& body) {
  double off_m = 0;
  for (const auto& edge : body.straight_edges) off_m = std::max(off_m, edge.off_m);
  return off_m;
}

/// A line of the table of tests/evidence/cad_parts.md.
void write_row(const CadPart& part, double seconds, const meshes::BodyMesh& body) {
  const char* file = std::getenv("MILLSTRESS_CAD_ROWS");
  if (file == nullptr) return;
  char figures[100];
  std::snprintf(figures, sizeof figures, "%.1f | %zu | %.3f", seconds, body.quality.n_cells,
                body.quality.min_scaled_jacobian);
  std::string remark;
  if (const int n = n_tips(body); n > 0)
    remark += std::to_string(n) + (n > 1 ? " tips" : " tip") + " left out";
  if (!body.straight_edges.empty()) {
    char text[100];
    const std::size_t n = body.straight_edges.size();
    std::snprintf(text, sizeof text, "%s%zu %s straighter than %s surface, by %.2g mm%s",
                  remark.empty() ? "" : "; ", n, n == 1 ? "edge" : "edges", n == 1 ? "its" : "their",
                  1e3 * largest_off_m(body), n == 1 ? "" : " at most");
    remark += text;
  }
  std::ofstream(file, std::ios::app) << "| " << part.name << " | " << figures << " | " << remark << " |\n";
}

void expect_meshed(const CadPart& part) {
  SCOPED_TRACE(part.name);
  const auto sample = drawn(part);
  const double begin_s = cpu_seconds_with_children();
  const auto body = meshes::build_imported(as_it_is(sample.file));
  const double seconds = cpu_seconds_with_children() - begin_s;
  constexpr double most_s = 20;  // of a core: what a user waits for a small part
  EXPECT_LT(seconds, most_s);
  // Parabolas around 16 cells lose 5e-5 of a circle, straight edges in wedges and the cells at a tip less.
  EXPECT_NEAR(read_tetrahedra(body).volume_m3 / sample.volume_m3, 1, 1e-3);
  EXPECT_GT(body.quality.min_scaled_jacobian, 0.005);
  EXPECT_EQ(n_tips(body), part.n_tips);
  // Cells keep a 16th of a circle: its chord lies by 1 - cos(pi / 16) of the radius beside it.
  for (const auto& edge : body.straight_edges) EXPECT_LT(edge.off_m, 0.2 * edge.length_m);
  write_row(part, seconds, body);
}

// gmsh made cells ever smaller towards a tip until its time was up, and blamed the part; curved cells between
// tangent faces were inverted at every fineness.
TEST(CadParts, OfEveryKindAreMeshedAsTheyAre) {
  if (std::getenv("MILLSTRESS_CAD_PARTS") != nullptr) {
    for (const auto& part : cad_parts())
      if (part.refusal.empty()) expect_meshed(part);
    return;
  }
  for (const char* name : {"centre hole to a point", "drill tip, 118 degrees", "pointed bar",
                           "tangent arm on a boss", "connecting rod", "fillet beside an arm"})
    expect_meshed(part_called(name));
}

// Two balls that touch in a point were one body, joined by one node.
TEST(CadParts, ThatCannotBeMeshedAreRefusedWithPlaceAndRemedy) {
  for (const auto& part : cad_parts())
    if (!part.refusal.empty())
      expect_words(refusal_of([&] { meshes::build_imported(as_it_is(drawn(part).file)); }), part.refusal);
}

// Finer cells between tangent faces are flatter: that is no reason to refuse them.
TEST(CadParts, TangentFacesAreMeshedFinelyToo) {
  auto import = as_it_is(drawn(part_called("lever, one side tangent")).file);
  import.control.size_factor = 0.4;
  const auto body = meshes::build_imported(import);
  EXPECT_FALSE(body.straight_edges.empty());
  EXPECT_LT(largest_off_m(body), 1e-4);
}

}  // namespace
