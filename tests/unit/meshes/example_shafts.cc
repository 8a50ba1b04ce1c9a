#include "tests/unit/meshes/example_shafts.h"

#include <gtest/gtest.h>
#include <unistd.h>

using meshes::Shaft;

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
