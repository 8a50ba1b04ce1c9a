#include "tests/cases/program/step_shafts.h"

#include <fmt/core.h>
#include <gmsh.h>

#include <cmath>

namespace step_shafts {
namespace {

const std::string head = R"(title = "Shaft with a known stress"
effects = ["load"]

[machine]
type = "load_table"
speed = "1000 rpm"
)";

const std::string material = R"(
[{0}.material]
name = "steel"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
)";

std::string constant(const std::string& load, const std::string& value) {
  return fmt::format("\n[[machine.constants]]\neffect = \"load\"\nload = \"{}\"\nvalue = \"{}\"\n", load,
                     value);
}

const std::string supports =
    "bearings = [\"left\", \"right\"]\naxial_support = \"right\"\ntorque_support = \"right\"\n";

/// Half the lengthwise section from the axis or bore outwards: corners, with the centres of fillets.
struct Profile {
  struct Corner {
    double z = 0, r = 0;
    bool is_arc_to_next = false;
    double centre_z = 0, centre_r = 0;
  };
  std::vector<Corner> corners;
};

Profile profile_of(const StepShaft& shaft) {
  Profile profile;
  auto& corners = profile.corners;
  double z = 0;
  corners.push_back({0, shaft.bore_mm / 2});
  corners.push_back({0, shaft.segments.front().diameter_mm / 2});
  for (std::size_t i = 0; i + 1 < shaft.segments.size(); ++i) {
    z += shaft.segments[i].length_mm;
    const double here = shaft.segments[i].diameter_mm / 2, next = shaft.segments[i + 1].diameter_mm / 2,
                 f = shaft.fillets_mm[i];
    if (here == next) {  // a point of its own, so that the port ends there
      corners.push_back({z, here});
    } else if (here < next) {
      corners.push_back({z - f, here, true, z - f, here + f});
      corners.push_back({z, here + f});
      if (here + f < next) corners.push_back({z, next});
    } else {
      if (next + f < here) corners.push_back({z, here});
      corners.push_back({z, next + f, true, z + f, next + f});
      corners.push_back({z + f, next});
    }
  }
  z += shaft.segments.back().length_mm;
  corners.push_back({z, shaft.segments.back().diameter_mm / 2});
  corners.push_back({z, shaft.bore_mm / 2});
  return profile;
}

}  // namespace

std::vector<StepShaft> all() {
  const std::vector<Segment> stepped = {
      {"left", 40, 40, true}, {"thin", 40, 60}, {"thick", 60, 80}, {"right", 60, 40, true}};
  const auto wider = [&](double large_mm) {
    auto result = stepped;
    result[2].diameter_mm = result[3].diameter_mm = large_mm;
    return result;
  };
  const double pi = std::acos(-1.0), section = pi * 0.04 * 0.04;
  const double torsion_MPa = 4e-6 * 1000 / (section * 0.04) * 4,
               bending_MPa = 8e-6 * 500 / (section * 0.04) * 4, tension_MPa = 4e-6 * 100e3 / section;
  return {
      {"torsion",
       wider(60),
       {0, 4, 0},
       0,
       constant("left.torque", "1 kN m"),
       supports,
       190.19,
       1.379884 * torsion_MPa,
       true},
      {"bending",
       wider(60),
       {0, 4, 0},
       0,
       constant("left.mx", "500 N m") + constant("right.mx", "-500 N m"),
       supports,
       130.12,
       1.80024 * bending_MPa},
      {"tension",
       wider(60),
       {0, 8, 0},
       0,
       constant("left.fz", "-100 kN"),
       supports,
       124.16,
       1.70313 * tension_MPa},
      {"groove",
       {{"left", 50, 40, true},
        {"thick", 50, 50},
        {"groove", 40, 12},
        {"end", 50, 50},
        {"right", 50, 40, true}},
       {0, 4, 4, 0},
       0,
       constant("left.mx", "500 N m") + constant("right.mx", "-500 N m"),
       supports,
       126.71},
      {"hollow",
       wider(60),
       {0, 4, 0},
       24,
       constant("left.torque", "1 kN m") + constant("left.mx", "500 N m") + constant("right.mx", "-500 N m"),
       supports,
       260.05},
  };
}

void write_drawn(const std::filesystem::path& file, const std::function<void()>& draw) {
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("drawn");
  draw();
  gmsh::write(file.string());
  gmsh::finalize();
}

void fuse(const std::vector<int>& tags) {
  gmsh::vectorpair others, result;
  for (std::size_t i = 1; i < tags.size(); ++i) others.emplace_back(3, tags[i]);
  std::vector<gmsh::vectorpair> map;
  gmsh::model::occ::fuse({{3, tags.front()}}, others, result, map);
  gmsh::model::occ::synchronize();
}

std::string one_turn(int n_instants) {
  return fmt::format(R"(
[sampling]
instants_per_turn = {}
turns = 1

[results]
snapshots = 0
pictures = false
)",
                     n_instants);
}

std::string box_port(const std::string& name, const std::array<double, 3>& low,
                     const std::array<double, 3>& high) {
  const auto point = [](const std::array<double, 3>& p) {
    return fmt::format("[\"{} mm\", \"{} mm\", \"{} mm\"]", p[0], p[1], p[2]);
  };
  return fmt::format("\n[[part.ports]]\nport = \"{}\"\nbox = {{ low = {}, high = {} }}\n", name, point(low),
                     point(high));
}

void write_step(const StepShaft& shaft, const std::filesystem::path& file) {
  namespace occ = gmsh::model::occ;
  write_drawn(file, [&] {
    const auto profile = profile_of(shaft);
    std::vector<int> points, lines;
    for (const auto& c : profile.corners) points.push_back(occ::addPoint(c.r, 0, c.z));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& c = profile.corners[i];
      const int from = points[i], to = points[(i + 1) % points.size()];
      lines.push_back(c.is_arc_to_next ? occ::addCircleArc(from, occ::addPoint(c.centre_r, 0, c.centre_z), to)
                                       : occ::addLine(from, to));
    }
    gmsh::vectorpair parts;
    occ::revolve({{2, occ::addPlaneSurface({occ::addWire(lines)})}}, 0, 0, 0, 0, 0, 1, 2 * std::acos(-1.0),
                 parts);
    occ::synchronize();
  });
}

std::string scene_of_step(const StepShaft& shaft, const std::string& mesh_keys) {
  std::string text = head + shaft.loads + one_turn(16) +
                     fmt::format("\n[part]\nfile = \"{}.step\"\n", shaft.name) + shaft.supports;
  double z = 0;
  for (const auto& s : shaft.segments) {
    if (s.is_port)
      text += fmt::format(
          "[[part.ports]]\nport = \"{}\"\ncylinder = {{ diameter = \"{} mm\", begin = \"{} mm\", end = \"{} "
          "mm\" }}\n",
          s.name, s.diameter_mm, z - 0.01, z + s.length_mm + 0.01);
    z += s.length_mm;
  }
  return text + "[part.mesh]\n" + mesh_keys + fmt::format(material, "part");
}

std::string scene_of_blocks(const StepShaft& shaft) {
  std::string text = head + shaft.loads + one_turn(16) + "\n[shaft]\ncontour = [\n";
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const auto& s = shaft.segments[i];
    text += fmt::format("  {{ {} = \"{}\", diameter = \"{} mm\", length = \"{} mm\"",
                        s.is_port ? "port" : "name", s.name, s.diameter_mm, s.length_mm);
    if (shaft.bore_mm > 0) text += fmt::format(", bore = \"{} mm\"", shaft.bore_mm);
    text += " },\n";
    if (i < shaft.fillets_mm.size() && shaft.fillets_mm[i] > 0)
      text += fmt::format("  {{ fillet = \"{} mm\" }},\n", shaft.fillets_mm[i]);
  }
  return text + "]\nbegin = \"0 mm\"\n" + shaft.supports +
         "[shaft.mesh]\ncells_per_fillet_quarter = 6\nsectors = 16\n" + fmt::format(material, "shaft");
}

}  // namespace step_shafts
