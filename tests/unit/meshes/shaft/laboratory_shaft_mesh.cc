#include <gtest/gtest.h>

#include <cmath>

#include "meshes/shaft/shaft.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"

namespace {

const meshes::Port& port(const meshes::BodyMesh& body, const std::string& name) {
  for (const auto& port : body.ports)
    if (port.name == name) return port;
  throw std::runtime_error("no port " + name);
}

/// Facts of the design: structured blocks keep the worst corner above 0.49; the shaft with 8 cells per
/// quarter and 16 sectors stays within a direct solver's reach (335 thousand quadratic unknowns, some 25 per
/// cell).
TEST(LaboratoryShaft, MeshesWellAtEveryFineness) {
  for (const int cells : {2, 4, 8, 16}) {
    meshes::ShaftMeshControl control;
    control.cells_per_fillet_quarter = cells;
    const auto quality = meshes::build_shaft(laboratory_shaft(), control).quality;
    RecordProperty("cells_" + std::to_string(cells), static_cast<int>(quality.n_cells));
    RecordProperty("min_scaled_jacobian_" + std::to_string(cells),
                   std::to_string(quality.min_scaled_jacobian));
    EXPECT_GT(quality.min_scaled_jacobian, 0.6) << cells;
    EXPECT_GT(quality.median_scaled_jacobian, 0.95) << cells;
    if (cells == 8) {
      EXPECT_GT(quality.n_cells, 8000u);
      EXPECT_LT(quality.n_cells, 13400u);
    }
  }
}

/// The loaded zone is the segment less the larger of its own fillets at both ends, so that the resultant of a
/// uniform pressure acts in the middle of the seat: a shift by half a fillet would add a moment.
TEST(LaboratoryShaft, LoadsItsSeatsSymmetrically) {
  const auto shaft = laboratory_shaft();
  const auto body = meshes::build_shaft(shaft, {});
  const double tiny = 1e-15;
  for (const auto& segment : shaft.segments) {
    if (!segment.is_port) continue;
    const auto& seat = port(body, segment.name);
    EXPECT_NEAR(seat.begin_m + seat.end_m, segment.begin_m + segment.end_m, tiny) << segment.name;
  }
  EXPECT_NEAR(port(body, "main_bearing_2").begin_m, 0.1695, tiny);
  EXPECT_NEAR(port(body, "main_bearing_2").end_m, 0.1905, tiny);
  EXPECT_NEAR(port(body, "eccentric_seat").begin_m, -0.03, tiny);  // no fillet of its own
  EXPECT_NEAR(port(body, "coupling").begin_m, -0.2715, tiny);      // the free end loses as much as the fillet
}

/// Pressure needs a few cells along the axis to act on.
TEST(LaboratoryShaft, HasAtLeastFourCellsAlongEachSeat) {
  const auto body = meshes::build_shaft(laboratory_shaft(), {});
  const MeshFile mesh = read_mesh_file(body);
  for (const auto& seat : body.ports) {
    if (seat.kind != meshes::Port::Kind::seat) continue;
    int n_faces = 0;
    for (const auto& quad : mesh.quads) n_faces += quad.group == seat.boundary_id;
    EXPECT_GE(n_faces / 16, 4) << seat.name;
  }
}

TEST(LaboratoryShaft, OffersItsPortsWithTheirOwnAxes) {
  const auto body = meshes::build_shaft(laboratory_shaft(), {});
  ASSERT_EQ(body.ports.size(), 8u);  // six seats and two ends
  for (const auto& p : body.ports) EXPECT_EQ(p.axis_x_m, p.name == "eccentric_seat" ? 0.004 : 0) << p.name;
  EXPECT_EQ(port(body, "end_1").begin_m, -0.2725);
  EXPECT_EQ(port(body, "end_1").radius_m, 0.0125);
  EXPECT_EQ(port(body, "end_2").end_m, 0.2275);
  EXPECT_EQ(port(body, "end_2").radius_m, 0.015);
}

TEST(LaboratoryShaft, NamesItsGroupsInTheFile) {
  const auto body = meshes::build_shaft(laboratory_shaft(), {});
  const MeshFile mesh = read_mesh_file(body);
  EXPECT_EQ(mesh.volume_names.size(), 9u);
  EXPECT_EQ(mesh.volume_names.begin()->second, "core");
  EXPECT_EQ(mesh.volume_names.at(body.cylinders[4].volume_id), "ring_eccentric_seat");
  ASSERT_EQ(mesh.boundary_names.size(), body.features.size());
  for (const auto& feature : body.features)
    EXPECT_EQ(mesh.boundary_names.at(feature.boundary_id), feature.name);
  for (const auto& p : body.ports) EXPECT_EQ(mesh.boundary_names.at(p.boundary_id), p.name);
}

}  // namespace
