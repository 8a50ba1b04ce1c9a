#include "tests/unit/meshes/examples/example_shafts.h"

#include <gtest/gtest.h>
#include <unistd.h>

using meshes::Shaft;

namespace {

/// Segments one after another; dimensions in mm.
struct Piece {
  std::string name;
  double diameter, length, bore;
  bool is_port = false;
  std::string bore_port{};
};

Shaft chain(double begin_m, const std::vector<Piece>& pieces, const std::vector<double>& fillets_mm) {
  Shaft shaft;
  double z_m = begin_m;
  for (const Piece& piece : pieces) {
    meshes::ShaftSegment segment;
    segment.name = piece.name;
    segment.begin_m = z_m;
    segment.end_m = z_m = z_m + 1e-3 * piece.length;
    segment.diameter_m = 1e-3 * piece.diameter;
    segment.bore_m = 1e-3 * piece.bore;
    segment.is_port = piece.is_port;
    segment.bore_port = piece.bore_port;
    shaft.segments.push_back(segment);
  }
  for (const double fillet : fillets_mm) shaft.fillets_m.push_back(1e-3 * fillet);
  return shaft;
}

}  // namespace

Shaft planetary_drum() {
  return chain(-0.678,
               {{"pulley_seat", 70, 98, 40, true},
                {"trunnion_1", 80, 40, 40, true},
                {"root_1", 95, 20, 40},
                {"cover_1", 216, 20, 40},
                {"shell", 216, 1000, 200, false, "inner_wall"},
                {"cover_2", 216, 20, 40},
                {"root_2", 95, 20, 40},
                {"trunnion_2", 80, 40, 40, true}},
               {3, 3, 10, 0, 0, 10, 3});
}

Shaft working_shaft() {
  return chain(-0.092,
               {{"pulley_seat", 24, 45, 0, true},
                {"bearing_1", 25, 15, 0, true},
                {"body", 30, 64, 0},
                {"bearing_2", 25, 15, 0, true},
                {"disc_seat", 24, 45, 0, true}},
               {0.4, 1, 1, 0.4});
}

Shaft stub_axle() {
  return chain(0, {{"bearing", 80, 70, 0, true}, {"flange", 140, 30, 0}, {"spigot", 100, 60, 0, true}},
               {5, 2});
}

Shaft two_eccentrics() {
  Shaft shaft = chain(0,
                      {{"left", 40, 60, 12},
                       {"up", 60, 30, 12, true},
                       {"neck", 44, 12, 12},
                       {"back", 66, 25, 12, true},
                       {"right", 40, 60, 12, true, "coolant"}},
                      {2, 1.5, 1.5, 2});
  const double pi = 3.14159265358979323846;
  shaft.segments[1].eccentricity_m = 0.004;
  shaft.segments[1].eccentricity_angle_rad = pi / 2;
  shaft.segments[3].eccentricity_m = 0.005;
  shaft.segments[3].eccentricity_angle_rad = -pi;
  return shaft;
}

std::vector<Shaft> stepped_bores() {
  return {
      chain(0, {{"left", 60, 50, 20}, {"middle", 60, 40, 0}, {"right", 60, 50, 46}}, {0, 0}),
      chain(0,
            {{"pipe", 80, 100, 60}, {"thick", 100, 60, 30}, {"seat", 100, 50, 30, true}, {"end", 70, 60, 30}},
            {0, 0, 4}),
      chain(0,
            {{"chamber_1", 200, 200, 180, false, "wall_1"},
             {"wall", 240, 15, 0},
             {"chamber_2", 210, 200, 190, false, "wall_2"}},
            {0, 0}),
      chain(0, {{"tube", 60, 50, 52}, {"plug", 60, 5, 0}, {"wheel", 90, 40, 0}}, {0, 4}),
      chain(0, {{"pin", 80, 60, 0}, {"cup", 100, 40, 30}, {"rim", 100, 60, 70}}, {0, 0}),
      chain(0, {{"pin", 80, 60, 20}, {"cup", 130, 40, 30}, {"rim", 130, 60, 100}}, {0, 0}),
      chain(0, {{"thin", 90, 80, 80}, {"middle", 90, 60, 50}, {"inner", 90, 60, 0}, {"pin", 40, 60, 0}},
            {0, 0, 6})};
}

Shaft grooved_shaft() {
  return chain(0,
               {{"seat", 35, 40, 10, true},
                {"relief", 33, 2.4, 10},
                {"collar", 50, 12, 10},
                {"body", 42, 60, 10},
                {"groove", 38, 3, 10},
                {"tail", 42, 40, 10, true}},
               {0.8, 1.4, 2, 0.9, 1.9});
}

Shaft laboratory_shaft() {
  const double mm = 1e-3;
  Shaft shaft;
  shaft.segments = {{"coupling", -272.5 * mm, -227.5 * mm, 25 * mm, 0, true},
                    {"debalance_1", -227.5 * mm, -191.5 * mm, 30 * mm, 0, true},
                    {"main_bearing_1", -191.5 * mm, -168.5 * mm, 35 * mm, 0, true},
                    {"body_1", -168.5 * mm, -30 * mm, 42 * mm, 0, false},
                    {"eccentric_seat", -30 * mm, 30 * mm, 60 * mm, 4 * mm, true},
                    {"body_2", 30 * mm, 168.5 * mm, 42 * mm, 0, false},
                    {"main_bearing_2", 168.5 * mm, 191.5 * mm, 35 * mm, 0, true},
                    {"debalance_2", 191.5 * mm, 227.5 * mm, 30 * mm, 0, true}};
  shaft.fillets_m = {1 * mm, 1 * mm, 1 * mm, 2.5 * mm, 2.5 * mm, 1 * mm, 1 * mm};
  return shaft;
}

Shaft shoulder_shaft(double big_diameter_m, double fillet_m) {
  Shaft shaft;
  shaft.segments = {{"small", -2, 0, 1, 0, false}, {"big", 0, 2, big_diameter_m, 0, false}};
  shaft.fillets_m = {fillet_m};
  return shaft;
}

Shaft plain_cylinder() {
  Shaft shaft;
  shaft.segments = {{"rod", 0, 0.2, 0.05, 0, true}};
  return shaft;
}

Shaft three_steps() {
  Shaft shaft;
  shaft.segments = {{"thin", 0, 0.1, 0.03, 0, false},
                    {"middle", 0.1, 0.2, 0.04, 0, false},
                    {"thick", 0.2, 0.3, 0.05, 0, false}};
  shaft.fillets_m = {0, 0};
  return shaft;
}

Shaft sharp_eccentric_shaft() {
  Shaft shaft;
  shaft.segments = {{"left", 0, 0.1, 0.04, 0, false},
                    {"disc", 0.1, 0.15, 0.06, -0.004, true},
                    {"right", 0.15, 0.2, 0.03, 0, false}};
  shaft.fillets_m = {0, 0};
  return shaft;
}

std::filesystem::path temporary_msh(const std::string& name) {
  const auto directory =
      std::filesystem::path(::testing::TempDir()) / ("millstress_meshes_" + std::to_string(::getpid()));
  std::filesystem::create_directories(directory);
  return directory / (name + ".msh");
}
