/// Masses of load stage and mesh: open ones come from the mesh, differences are carried and close the body,
/// large ones are refused.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/loads/stage/machine_masses.h"
#include "tests/unit/pipelines/examples/chamber_body.h"
#include "tests/unit/pipelines/examples/plain_body.h"

namespace {

using pipelines::agree_masses;
using pipelines::MassAgreement;
using pipelines::MassFigure;
using pipelines::MeshedBody;
using pipelines::Scene;

/// The laboratory scene with its chamber alone: covers of 2 kg and bearing rings of 0.9 kg added.
Scene chamber_scene() {
  auto scene = laboratory::scene();
  scene.bodies = {*scene.body("chamber")};
  return scene;
}

/// A mesh that, with the scene's added masses, has exactly the machine's figures.
MeshedBody perfect_mesh() {
  const auto body = chamber::body();
  MeshedBody result;
  result.mesh.ports = body.ports;
  result.regions = body.regions;
  auto &structure = result.regions[0].masses, &exciter = result.regions[1].masses;
  structure.mass_kg -= 2;
  structure.first_moment_kg_m[0] -= 2 * 0.28;
  structure.first_moment_kg_m[1] -= 2 * 0.04;
  structure.second_moments_kg_m2[0] -= 0.0296 + 2 * (0.28 * 0.28 + 0.04 * 0.04);
  exciter.mass_kg -= 0.9;
  exciter.second_moments_kg_m2[0] -= 0.003;
  return result;
}

/// Structure 3 % light and off to one side, exciter 8 % heavy and out of centre, inertia 5 % high.
MeshedBody mesh_that_is_off() {
  auto result = perfect_mesh();
  auto &structure = result.regions[0].masses, &exciter = result.regions[1].masses;
  structure.mass_kg -= 0.9;
  structure.first_moment_kg_m[0] -= 0.5;
  structure.first_moment_kg_m[1] += 0.1;
  structure.second_moments_kg_m2[1] += 0.1425;
  exciter.mass_kg += 0.48;
  exciter.first_moment_kg_m = {0.02, -0.01, 0};
  return result;
}

chamber::Loaded distributed(const MassAgreement& agreed, const MeshedBody& meshed,
                            const std::vector<std::string>& effects) {
  const auto& mill = std::get<kinetics::VibratoryMill>(agreed.machine);
  auto loaded = chamber::body();
  loaded.regions = meshed.regions;
  chamber::Loaded result;
  result.history = kinetics::compute_loads(mill, effects, {20, 72});
  const auto& attached = agreed.attached.at("chamber");
  result.loads =
      distribute_chamber(result.history, mill, loaded, {effects, attached.structure, attached.exciter, {}});
  result.closure = bodies::closure_of(result.loads, loaded.regions);
  return result;
}

const MassFigure& figure(const MassAgreement& agreed, const std::string& name) {
  for (const auto& f : agreed.figures)
    if (f.name == name) return f;
  throw std::out_of_range(name);
}

/// fx of one effect.
Eigen::ArrayXd part_of(const kinetics::LoadHistory& loads, const std::string& role,
                       const std::string& effect) {
  for (const auto& part : loads.resultant(role).contributions)
    if (loads.effects[part.effect] == effect) return part.load.row(0).transpose();
  throw std::out_of_range(effect);
}

std::string refusal(const Scene& scene, const MeshedBody& meshed) {
  try {
    agree_masses(scene, {meshed});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MachineMasses, PerfectMeshLeavesRoundOff) {
  const auto agreed = agree_masses(chamber_scene(), {perfect_mesh()});
  ASSERT_EQ(agreed.figures.size(), 4u);
  for (const auto& f : agreed.figures) EXPECT_LT(f.share(), 1e-14) << f.name;
  const auto result = distributed(agreed, perfect_mesh(), chamber::spec_effects());
  EXPECT_LT(result.closure.worst_force(), 1e-12);
  EXPECT_LT(result.closure.worst_moment(), 1e-12);
  EXPECT_TRUE(bodies::has(result.loads, "covers.fx"));
  // The rings ride on the bore beside the exciter's own share of B: 0.9 kg times ecc omega^2.
  const Eigen::ArrayXd joint = part_of(result.history, "housing_bore", "exciter_inertia");
  const Eigen::ArrayXd rings = bodies::part(result.loads, "exciter_inertia", "housing_bore.fx") - joint;
  EXPECT_NEAR(bodies::largest(rings), 0.9 * 0.004 * 151.844 * 151.844, 1e-9);
}

TEST(MachineMasses, DifferencesCloseTheBodyAgain) {
  const auto meshed = mesh_that_is_off();
  for (const auto& effects : {chamber::spec_effects(), chamber::effects_without({"charge_lag"}),
                              chamber::spec_effects({"pitch"})}) {
    const auto agreed = agree_masses(chamber_scene(), {meshed});
    const auto repaired = distributed(agreed, meshed, effects);
    EXPECT_LT(repaired.closure.worst_force(), 1e-12);
    EXPECT_LT(repaired.closure.worst_moment(), 1e-12);
    auto without = agreed;
    for (auto* list : {&without.attached.at("chamber").structure, &without.attached.at("chamber").exciter})
      list->erase(list->begin() + 1, list->end());
    EXPECT_GT(distributed(without, meshed, effects).closure.worst_force(), 1e-3);
  }
}

TEST(MachineMasses, FiguresTellBothSides) {
  const auto agreed = agree_masses(chamber_scene(), {mesh_that_is_off()});
  EXPECT_NEAR(figure(agreed, "structure mass").mesh, 29.1, 1e-12);
  EXPECT_EQ(figure(agreed, "structure mass").given, 30);
  EXPECT_NEAR(figure(agreed, "structure mass").share(), 0.03, 1e-14);
  EXPECT_NEAR(figure(agreed, "structure first moment").mesh, std::hypot(30 * 0.26 - 0.5, 30 * 0.02 + 0.1),
              1e-12);
  EXPECT_EQ(figure(agreed, "structure first moment").port, "covers");
  EXPECT_EQ(figure(agreed, "exciter mass").port, "housing_bore");
  EXPECT_NEAR(figure(agreed, "exciter first moment").mesh, std::hypot(0.02, 0.01), 1e-12);
  EXPECT_NEAR(figure(agreed, "structure first moment").share(),
              std::hypot(0.5, 0.1) / (30 * std::hypot(0.26, 0.02)), 1e-13);
  EXPECT_NEAR(figure(agreed, "pitch inertia").share(), 0.05, 1e-13);
  EXPECT_NEAR(figure(agreed, "exciter mass").share(), 0.08, 1e-13);
  for (const auto& f : agreed.figures) EXPECT_FALSE(f.from_mesh);
  const auto& attached = agreed.attached.at("chamber");
  ASSERT_EQ(attached.structure.size(), 2u);
  EXPECT_EQ(attached.structure[1].port, "covers");
  EXPECT_NEAR(attached.structure[1].mass_kg, 0.9, 1e-13);
  EXPECT_NEAR(attached.structure[1].polar_inertia_kg_m2, -0.1425, 1e-13);
  ASSERT_EQ(attached.exciter.size(), 2u);
  EXPECT_EQ(attached.exciter[1].port, "housing_bore");
  EXPECT_NEAR(attached.exciter[1].mass_kg, -0.48, 1e-13);
}

// What the scene leaves open is the mesh's, with what is added to it.
TEST(MachineMasses, OpenMassesComeFromTheMesh) {
  auto scene = chamber_scene();
  scene.masses_from_mesh = {"structure", "exciter"};
  auto& mill = std::get<kinetics::VibratoryMill>(scene.machine);
  mill.structure_mass_kg = mill.exciter_mass_kg = mill.pitch_inertia_kg_m2 = 0;
  mill.structure_centre_m.setZero();
  auto meshed = mesh_that_is_off();
  meshed.regions[1].masses.first_moment_kg_m = {0, 0, 0};
  const auto agreed = agree_masses(scene, {meshed});
  const auto& found = std::get<kinetics::VibratoryMill>(agreed.machine);
  EXPECT_NEAR(found.structure_mass_kg, 29.1, 1e-12);
  EXPECT_NEAR(found.structure_mass_kg * found.structure_centre_m.x(), 30 * 0.26 - 0.5, 1e-12);
  EXPECT_NEAR(found.structure_mass_kg * found.structure_centre_m.y(), 30 * 0.02 + 0.1, 1e-12);
  EXPECT_NEAR(found.pitch_inertia_kg_m2, 2.85 + 0.1425, 1e-12);
  EXPECT_NEAR(found.exciter_mass_kg, 6.48, 1e-12);
  for (const auto& f : agreed.figures) {
    EXPECT_TRUE(f.from_mesh) << f.name;
    EXPECT_LT(f.share(), 1e-14) << f.name;
  }
  const auto result = distributed(agreed, meshed, chamber::spec_effects());
  EXPECT_LT(result.closure.worst_force(), 1e-12);
  EXPECT_LT(result.closure.worst_moment(), 1e-12);
}

TEST(MachineMasses, MoreThanAFifthIsAnotherMachine) {
  const auto off_by = [](double kg) {
    auto meshed = perfect_mesh();
    meshed.regions[0].masses.mass_kg += kg;
    return refusal(chamber_scene(), meshed);
  };
  EXPECT_EQ(off_by(0.199 * 30), "accepted");
  const std::string text = off_by(0.201 * 30);
  for (const char* piece : {"chamber", "structure mass", "30 kg", "36.03 kg", "20.1 %", "at most 20 %"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << " in " << text;
  auto meshed = perfect_mesh();
  meshed.regions[0].masses.first_moment_kg_m[1] += 0.3 * 30 * 0.26;
  EXPECT_NE(refusal(chamber_scene(), meshed).find("first moment"), std::string::npos);
  meshed = perfect_mesh();
  meshed.regions[1].masses.mass_kg *= 2;
  EXPECT_NE(refusal(chamber_scene(), meshed).find("exciter mass"), std::string::npos);
}

/// The load stage has exciter and drum centred on their axes: a mass added beside one would have its moment
/// cancelled. 3 kg at 0.15 m on an exciter of 0.9 + 5.1 kg.
TEST(MachineMasses, AMassBesideItsAxisIsTold) {
  auto scene = chamber_scene();
  scene.masses_from_mesh = {"structure", "exciter"};
  scene.bodies[0].added_masses[1].centre_m = {0, 0.15};
  scene.bodies[0].added_masses[1].mass_kg = 3;
  const std::string text = refusal(scene, perfect_mesh());
  EXPECT_NE(text.find("exciter first moment is 0 kg m, mesh and added masses give 0.45 kg m"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("moves_with = \"structure\""), std::string::npos) << text;
  scene.bodies[0].added_masses[1].region = "structure";
  EXPECT_EQ(refusal(scene, perfect_mesh()), "accepted");

  auto planetary = plain::scene("planetary_mill");
  planetary.bodies[0].added_masses[0].centre_m = {0.02, 0};
  const auto agreed = agree_masses(planetary, {plain::meshed(*planetary.body("drum"))});
  EXPECT_NEAR(figure(agreed, "drum first moment").mesh, 21.1 * 0.02, 1e-6);
}

TEST(MachineMasses, AddedMassOnAnUnknownPlaceIsNamed) {
  auto scene = chamber_scene();
  scene.bodies[0].added_masses[0].port = "cover";
  const std::string text = refusal(scene, perfect_mesh());
  EXPECT_NE(text.find("\"covers\" sits on the port \"cover\""), std::string::npos) << text;
}

TEST(MachineMasses, DrumAndItsPulley) {
  auto scene = plain::scene("planetary_mill");
  const auto meshed = plain::meshed(*scene.body("drum"));
  const auto agreed = agree_masses(scene, {meshed});
  // coupling.md 7.3: 58.3 kg of mesh and 21.1 kg of pulley; the fillets are the last 0.1 kg.
  EXPECT_NEAR(meshed.masses.mass_kg, 58.3, 0.15);
  ASSERT_EQ(agreed.figures.size(), 1u);
  EXPECT_NEAR(agreed.figures[0].mesh, meshed.masses.mass_kg + 21.1, 1e-12);
  const auto& attached = agreed.attached.at("drum").structure;
  ASSERT_EQ(attached.size(), 2u);
  EXPECT_NEAR(attached[1].mass_kg, 79.47 - 21.1 - meshed.masses.mass_kg, 1e-12);
  std::get<kinetics::PlanetaryMill>(scene.machine).drum_mass_kg = 110;
  EXPECT_NE(refusal(scene, meshed).find("drum mass"), std::string::npos);
}

}  // namespace
