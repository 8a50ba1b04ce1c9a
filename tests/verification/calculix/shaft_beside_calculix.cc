/// A shaft with unit loads here (27-node hexahedra) and in CalculiX (C3D20): the same mesh, the same loads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "fem/models/solid/model.h"
#include "pipelines/command/calculix/calculix_model.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "tests/benchmarks/solvers/benchmark_shaft.h"
#include "tests/unit/pipelines/examples/results_directory.h"
#include "tests/unit/pipelines/examples/tools.h"
#include "tests/verification/calculix/calculix_comparison.h"

namespace {

/// Bending, and torsion: loads of both kinds on the mesh, with their names.
std::vector<fem::UnitLoad> two_loads(const meshes::BodyMesh& mesh) {
  std::vector<fem::UnitLoad> loads;
  for (const auto& load : measure::seat_loads(mesh))
    if (load.channel == "gear_seat.fx" || load.channel == "fan_seat.torque") loads.push_back(load);
  return loads;
}

std::vector<int> fillets(const meshes::BodyMesh& mesh) {
  std::vector<int> ids;
  for (const auto& feature : mesh.features)
    if (feature.kind == meshes::Feature::Kind::fillet) ids.push_back(feature.boundary_id);
  return ids;
}

}  // namespace

TEST(ShaftBesideCalculix, DisplacementAndFilletStressAgree) {
  SKIP_WITHOUT("ccx");
  const results_test::Directory directory;
  const auto scene = pipelines::read_scene(SOURCE_DIR "/tests/benchmarks/shaft.toml");
  const auto part = measure::refined_shaft(scene, {2, 8});
  const auto mesh = pipelines::build_mesh(part);
  const auto body = pipelines::to_fem_body(mesh, part.material);
  const auto loads = two_loads(mesh);
  ASSERT_EQ(loads.size(), 2u);
  const auto nodal = fem::nodal_loads(body, loads);
  // Curved faces lose their middle: a fourth-order effect, 2.6e-7 on eight sectors.
  EXPECT_LT(pipelines::calculix_forces(nodal, pipelines::Serendipity(nodal.nodes)).moment_removed, 1e-5);
  pipelines::write_calculix_model(directory / "shaft.inp", scene.title, {loads[0].channel, loads[1].channel},
                                  part.material, nodal);
  const std::string ccx =
      "cd '" + directory.path.string() + "' && OMP_NUM_THREADS=1 ccx -i shaft > ccx.log 2>&1";
  ASSERT_EQ(std::system(ccx.c_str()), 0) << results_test::bytes(directory / "ccx.log");
  const auto ours = fem::Model(body).unit_responses(loads, {});
  const auto calculix = pipelines::read_calculix_results(directory / "shaft.frd", ours.nodes.n);
  const auto agreements =
      pipelines::compare_with_calculix(ours, nodal, calculix, part.material, fillets(mesh));
  ASSERT_EQ(agreements.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& at = agreements[k];
    SCOPED_TRACE(at.channel);
    // The space of C3D20 is a part of ours, so it does less work. By how much depends on the mesh: 8e-4 and
    // 4e-4 here, 1.6e-4 and 1.2e-4 with twice as many cells at a fillet. A force, length or modulus that is
    // off by more than 2e-3 shows.
    const double energy = 1 - at.calculix_compliance_J / at.compliance_J;
    EXPECT_GT(energy, 0);
    EXPECT_LT(energy, 2e-3);
    // The square root is the relative difference in the energy norm; displacement gains the factor h / L
    // (Aubin and Nitsche), cells of 24 mm on 300 mm.
    EXPECT_LT(at.displacement_difference, std::sqrt(energy) * 24 / 300);

    // Recovered stress here, stress extrapolated from Gauss points and averaged there: apart by no more than
    // what both are off by their own estimates, in every component.
    const double tolerance_Pa = at.ours.error_Pa + at.calculix.error_Pa;
    EXPECT_LT(tolerance_Pa, 0.25 * at.ours.von_mises_Pa);  // two cells per fillet quarter
    EXPECT_NEAR(at.calculix.von_mises_Pa, at.ours.von_mises_Pa, tolerance_Pa);
    for (std::size_t c = 0; c < 6; ++c)
      EXPECT_NEAR(calculix.stress_Pa[(k * ours.nodes.n + at.node) * 6 + c],
                  ours.stress_Pa[(at.node * 2 + k) * 6 + c], tolerance_Pa)
          << "component " << c;
  }
}
