#include "tests/verification/sharp_edges/sharp_parts.h"

#include <fmt/core.h>
#include <gmsh.h>

#include <cmath>
#include <fstream>
#include <numeric>

#include "tests/cases/program/step_shafts.h"

namespace sharp_parts {
namespace {

namespace occ = gmsh::model::occ;
using step_shafts::fuse;

int box(const Point& corner, const Point& size) {
  return occ::addBox(corner[0], corner[1], corner[2], size[0], size[1], size[2]);
}

/// The first without the second.
void cut(int tag, int tool) {
  gmsh::vectorpair result;
  std::vector<gmsh::vectorpair> map;
  occ::cut({{3, tag}}, {{3, tool}}, result, map);
  occ::synchronize();
}

/// A triangle in a plane of constant z, made as thick as said.
int wedge(const std::array<Point, 3>& corners, double thickness) {
  std::vector<int> points, lines;
  for (const auto& p : corners) points.push_back(occ::addPoint(p[0], p[1], p[2]));
  for (std::size_t i = 0; i < 3; ++i) lines.push_back(occ::addLine(points[i], points[(i + 1) % 3]));
  const int surface = occ::addPlaneSurface({occ::addCurveLoop(lines)});
  gmsh::vectorpair made;
  occ::extrude({{2, surface}}, 0, 0, thickness, made);
  for (const auto& entity : made)
    if (entity.first == 3) return entity.second;
  return 0;
}

/// The face across a coordinate of a box that lies at `at`, from `low` to `high` along the two others.
LoadedFace face(int across, double at, const std::array<double, 2>& low, const std::array<double, 2>& high) {
  constexpr double room = 0.1;
  LoadedFace result;
  int other = 0;
  for (int d = 0; d < 3; ++d) {
    const auto i = std::size_t(d);
    const double from = d == across ? at : low[std::size_t(other)],
                 to = d == across ? at : high[std::size_t(other)];
    if (d != across) ++other;
    result.low[i] = from - room;
    result.high[i] = to + room;
    result.centre[i] = (from + to) / 2;
  }
  return result;
}

std::string port_text(const std::string& name, const LoadedFace& face) {
  return step_shafts::box_port(name, face.low, face.high);
}

}  // namespace

std::vector<SharpPart> all() {
  const auto base = [] { return box({0, 0, 0}, {60, 12, 40}); };
  const auto upright = [] { return box({0, 12, 0}, {12, 48, 40}); };
  const LoadedFace base_end = face(0, 60, {0, 0}, {12, 40}), upright_end = face(1, 60, {0, 0}, {12, 40});
  const auto along_x = [](double from, double to, const std::array<double, 2>& high) {
    return std::pair(face(0, from, {0, 0}, high), face(0, to, {0, 0}, high));
  };
  const auto plate = along_x(0, 80, {40, 12}), block = along_x(0, 80, {50, 25}),
             grooved = along_x(0, 80, {40, 30});
  return {
      {"L bracket",
       [=] {
         fuse({base(), upright()});
       },
       upright_end, base_end, 3000},
      {"T joint",
       [] {
         fuse({box({-50, 0, 0}, {100, 12, 40}), box({-6, 12, 0}, {12, 50, 40})});
       },
       face(1, 62, {-6, 0}, {6, 40}), face(0, 50, {0, 0}, {12, 40}), 3000},
      {"gusset",
       [=] {
         fuse({base(), upright(), wedge({{{12, 12, 16}, {40, 12, 16}, {12, 40, 16}}}, 8)});
       },
       upright_end, base_end, 6000},
      {"stepped plate",
       [] {
         fuse({box({0, 0, 0}, {50, 40, 20}), box({50, 10, 0}, {50, 20, 20})});
       },
       face(0, 100, {10, 0}, {30, 20}), face(0, 0, {0, 0}, {40, 20}), 40000},
      {"pocket",
       [] {
         cut(box({0, 0, 0}, {80, 50, 25}), box({15, 12, 10}, {50, 26, 15}));
       },
       block.second, block.first, 60000},
      {"slot",
       [] {
         cut(box({0, 0, 0}, {80, 40, 12}), box({30, 10, 0}, {20, 20, 12}));
       },
       plate.second, plate.first, 20000},
      {"groove",
       [] {
         cut(box({0, 0, 0}, {80, 40, 30}), box({35, 0, 22}, {10, 40, 8}));
       },
       grooved.second, grooved.first, 40000},
      {"cross",
       [] {
         fuse({box({-40, -8, 0}, {80, 16, 16}), box({-8, -40, 0}, {16, 80, 16})});
       },
       face(0, 40, {-8, 0}, {8, 16}), face(1, 40, {-8, 0}, {8, 16}), 4000},
      {"boss",
       [] {
         fuse({box({-40, -30, 0}, {80, 60, 10}), occ::addCylinder(0, 0, 10, 0, 0, 20, 12)});
       },
       {{-12.1, -12.1, 29.9}, {12.1, 12.1, 30.1}, {0, 0, 30}},
       face(0, -40, {-30, 0}, {30, 10}),
       4000},
      {"stepped bar",
       [] {
         fuse({occ::addCylinder(0, 0, 0, 40, 0, 0, 15), occ::addCylinder(40, 0, 0, 40, 0, 0, 10)});
       },
       {{79.9, -10.1, -10.1}, {80.1, 10.1, 10.1}, {80, 0, 0}},
       {{-0.1, -15.1, -15.1}, {0.1, 15.1, 15.1}, {0, 0, 0}},
       30000},
  };
}

std::vector<SharpPart> with_vertices() {
  const auto plate = [] { return box({-50, 0, 0}, {100, 10, 40}); };
  const auto rib = [] { return box({-20, 10, 16}, {40, 15, 8}); };
  const LoadedFace left = face(0, -50, {0, 0}, {10, 40}), right = face(0, 50, {0, 0}, {10, 40}),
                   whole_top = face(1, 60, {0, 0}, {60, 60}), whole_end = face(0, 60, {0, 0}, {60, 60});
  return {
      {"three plates",
       [] {
         fuse({box({0, 0, 0}, {60, 10, 60}), box({0, 10, 0}, {10, 50, 60}), box({10, 10, 0}, {50, 50, 10})});
       },
       whole_top, whole_end, 30000},
      {"missing corner",
       [] {
         cut(box({0, 0, 0}, {60, 60, 60}), box({30, 30, 30}, {30, 30, 30}));
       },
       whole_end, face(0, 0, {0, 0}, {60, 60}), 200000},
      {"rib",
       [=] {
         fuse({plate(), rib()});
       },
       right, left, 40000},
      {"sloped rib",
       [=] {
         fuse({plate(), rib(), wedge({{{20, 10, 16}, {35, 10, 16}, {20, 25, 16}}}, 8),
               wedge({{{-20, 10, 16}, {-20, 25, 16}, {-35, 10, 16}}}, 8)});
       },
       right, left, 40000},
      {"crossing ribs",
       [=] {
         fuse({plate(), box({-40, 10, 16}, {80, 12, 8}), box({-4, 10, 4}, {8, 12, 32})});
       },
       right, left, 40000},
  };
}

std::filesystem::path write_scene(const SharpPart& part, const std::filesystem::path& directory) {
  step_shafts::write_drawn(directory / "part.step", part.draw);
  Point along{};
  for (std::size_t d = 0; d < 3; ++d) along[d] = part.pulled.centre[d] - part.held.centre[d];
  const double length = std::hypot(along[0], along[1], along[2]);
  std::string loads;
  for (std::size_t d = 0; d < 3; ++d) {
    const double force_N = part.force_N * along[d] / length;
    if (force_N == 0) continue;
    loads += fmt::format(
        "\n[[machine.constants]]\neffect = \"pull\"\nload = \"pulled.f{}\"\nvalue = \"{:.17g} N\"\n",
        "xyz"[d], force_N);
  }
  const auto scene = directory / "scene.toml";
  std::ofstream(scene) << "title = \"" << part.name << R"("
effects = ["pull"]

[machine]
type = "load_table"
speed = "1000 rpm"
)" << loads << step_shafts::one_turn(12)
                       << R"(
[part]
file = "part.step"
clamp = "held"
)" << port_text("pulled", part.pulled)
                       << port_text("held", part.held) << R"(
[part.material]
name = "steel"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "355 MPa"
)";
  return scene;
}

}  // namespace sharp_parts
