#include "pipelines/loads/bodies/chamber.h"

#include <fmt/core.h>

#include <cmath>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/stage/mass_comparison.h"
#include "pipelines/scene/kinds/body_names.h"
#include "pipelines/scene/values/effect_names.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

constexpr auto bore = ChamberNames::bore, wall = ChamberNames::wall;
constexpr auto foot = ChamberNames::foot;

/// -s'' of the translation on the circle: s = ecc e(phi), e(phi) = (cos phi, -sin phi), phi clockwise.
Array2Xd inertial_translation(const kinetics::LoadHistory& loads, double eccentricity_m) {
  const ArrayXd c = loads.phi_rad.cos(), s = loads.phi_rad.sin();
  const ArrayXd w2 = loads.speed_rad_s.square(), alpha = loads.acceleration_rad_s2;
  Array2Xd a(2, loads.n_instants());
  a.row(0) = (eccentricity_m * (w2 * c + alpha * s)).transpose();
  a.row(1) = (eccentricity_m * (-w2 * s + alpha * c)).transpose();
  return a;
}

/// Everything that is accelerated, part by part.
class ChamberParts {
public:
  ChamberParts(LoadCollector& collector, const LoadedBody& body, const ChamberLoading& loading)
      : collector_(collector), body_(body), loading_(loading) {}

  void structure(std::size_t effect, const AccelerationField& field) {
    collector_.accelerate(body_.region("structure"), effect, field);
    for (const auto& mass : loading_.structure) collector_.accelerate(mass, effect, field);
  }
  void exciter(std::size_t effect, const AccelerationField& field) {
    for (const auto& region : body_.regions)
      if (region.name == "exciter") collector_.accelerate(region, effect, field);
    for (const auto& mass : loading_.exciter) collector_.accelerate(mass, effect, field);
  }
  void all(const std::string& name, const AccelerationField& field) {
    const auto effect = collector_.effect(name);
    structure(effect, field);
    exciter(effect, field);
  }

  struct Inertia {
    double mass_kg = 0, x_m = 0, y_m = 0, polar_kg_m2 = 0;  // about the mass centre
  };
  Inertia about_mass_centre() const {
    double mass = 0, sx = 0, sy = 0, polar = 0;
    for (const auto& region : body_.regions) {
      const auto& m = region.masses;
      mass += m.mass_kg;
      sx += m.first_moment_kg_m[0];
      sy += m.first_moment_kg_m[1];
      polar += m.second_moments_kg_m2[0] + m.second_moments_kg_m2[1];
    }
    for (const auto* list : {&loading_.structure, &loading_.exciter})
      for (const auto& m : *list) {
        mass += m.mass_kg;
        sx += m.first_moment_kg_m[0];
        sy += m.first_moment_kg_m[1];
        polar += m.polar_inertia_kg_m2;
      }
    return {mass, sx / mass, sy / mass, polar - (sx * sx + sy * sy) / mass};
  }

private:
  LoadCollector& collector_;
  const LoadedBody& body_;
  const ChamberLoading& loading_;
};

/// The couple that holds the attitude: a rotation about the mass centre has no resultant force.
void guide_by_body(ChamberParts& parts, const ArrayXd& couple_Nm) {
  const auto inertia = parts.about_mass_centre();
  const ArrayXd angular = couple_Nm / inertia.polar_kg_m2;
  AccelerationField field{Array3Xd::Zero(3, couple_Nm.size()), angular, {}};
  field.translation_m_s2.row(0) = (inertia.y_m * angular).transpose();  // angular z x (p - p_G)
  field.translation_m_s2.row(1) = (-inertia.x_m * angular).transpose();
  parts.all(pitch_guide, field);
}

void guide_by_feet(LoadCollector& collector, const LoadedBody& body, const ArrayXd& couple_Nm) {
  std::array<double, 2> x{};
  for (const auto& port : body.ports)
    for (std::size_t i = 0; i < 2; ++i)
      if (port.name == foot(i + 1)) x[i] = port.axis_x_m;
  Array2Xd force = Array2Xd::Zero(2, couple_Nm.size());
  force.row(1) = (couple_Nm / (x[1] - x[0])).transpose();
  const auto guide = collector.effect(pitch_guide);
  collector.force(foot(2), guide, force);
  collector.force(foot(1), guide, -force);
}

/// A file's ports lie where the machine has its loads, or these do not balance.
void require_places(const BodyScene& body, const kinetics::VibratoryMill& mill, const LoadedBody& loaded) {
  constexpr double off = 1e-6;  // share of the distance between the axes
  const double allowed_m = off * mill.chamber_centre_m.norm();
  const auto require = [&](const std::string& name, const std::string& key, const Eigen::Vector2d& wanted_m) {
    for (const auto& port : loaded.ports)
      if (port.name == name &&
          std::hypot(port.axis_x_m - wanted_m[0], port.axis_y_m - wanted_m[1]) > allowed_m)
        throw StageRefused(
            fmt::format("{}: its port \"{}\" is at ({:.7g}, {:.7g}) mm, where {} is ({:.7g}, {:.7g}) "
                        "mm: loads there would not balance; write the same place to both",
                        body.origin, name, port.axis_x_m * 1e3, port.axis_y_m * 1e3, key, wanted_m[0] * 1e3,
                        wanted_m[1] * 1e3));
  };
  require(bore, "the eccentric's axis", {0, 0});
  require(wall, "machine.chamber.centre", mill.chamber_centre_m);
  for (std::size_t i = 1; i <= mill.springs.size(); ++i)
    require(foot(i), fmt::format("machine.springs[{}].position", i), mill.springs[i - 1].position_m);
}

class ChamberLoads : public LoadMaker {
public:
  void agree_masses(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                    MassAgreement& result) const override {
    auto& mill = std::get<kinetics::VibratoryMill>(result.machine);
    auto& attached = result.attached[body.name];
    attached.structure = added_masses(body, meshed.mesh, "structure");
    attached.exciter = added_masses(body, meshed.mesh, "exciter");
    PlanarMass structure, exciter;
    for (const auto& region : meshed.regions)
      (region.name == "exciter" ? exciter : structure) += planar_mass(region.masses);
    structure += planar_mass(attached.structure);
    exciter += planar_mass(attached.exciter);

    const bool open = is_open(scene, "structure"), exciter_open = is_open(scene, "exciter");
    if (exciter_open) mill.exciter_mass_kg = exciter.mass_kg;
    if (open) {
      mill.structure_mass_kg = structure.mass_kg;
      mill.structure_centre_m = {structure.x_kg_m / structure.mass_kg, structure.y_kg_m / structure.mass_kg};
      mill.pitch_inertia_kg_m2 = structure.polar_kg_m2 + exciter.polar_kg_m2;
    }
    MassComparison comparison(body, result.figures);
    const double m1 = mill.structure_mass_kg;
    PlanarMass rest;
    const auto& port = body.difference_port;
    rest.mass_kg = comparison.compare("structure mass", "kg", m1, structure.mass_kg, open, port);
    const double sx = m1 * mill.structure_centre_m[0], sy = m1 * mill.structure_centre_m[1];
    rest.x_kg_m = sx - structure.x_kg_m;
    rest.y_kg_m = sy - structure.y_kg_m;
    comparison.compare_moments("structure first moment", {sx, sy}, {structure.x_kg_m, structure.y_kg_m}, open,
                               port);
    rest.polar_kg_m2 = comparison.compare("pitch inertia", "kg m2", mill.pitch_inertia_kg_m2,
                                          structure.polar_kg_m2 + exciter.polar_kg_m2, open, port);
    add_difference(attached.structure, port, rest);
    PlanarMass rest_2;
    rest_2.mass_kg =
        comparison.compare("exciter mass", "kg", mill.exciter_mass_kg, exciter.mass_kg, exciter_open, bore);
    comparison.compare_centre("exciter first moment", exciter, bore,
                              "the exciter's centre is on the eccentric's axis; write moves_with = "
                              "\"structure\" for added masses beside it");
    rest_2.x_kg_m = -exciter.x_kg_m;  // the load stage has its centre at E'
    rest_2.y_kg_m = -exciter.y_kg_m;
    add_difference(attached.exciter, bore, rest_2);
  }
  std::vector<RegionMass> regions(const MeshedBody& meshed) const override {
    if (meshed.mesh.regions.empty()) return {{"structure", {}, meshed.masses}};
    std::vector<RegionMass> regions;
    for (const auto& region : meshed.mesh.regions)
      regions.push_back({region.name, region.volume_ids, meshed.model->mass_properties(region.volume_ids)});
    return regions;
  }
  BodyLoads distribute(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                       const LoadedBody& loaded, const MassAgreement& masses) const override {
    require_places(body, scene.vibratory_mill(), loaded);
    const auto& attached = masses.attached.at(body.name);
    return distribute_chamber(history, std::get<kinetics::VibratoryMill>(masses.machine), loaded,
                              {scene.effects, attached.structure, attached.exciter,
                               std::get<ChamberOptions>(body.options).pitch_guide});
  }
  /// A couple that no machine part carries is worth a word once it matters.
  std::string warning(const Scene&, const BodyScene& body, const BodyLoads& loads) const override {
    const double most = loads.carried_moment_Nm.size() > 0 ? loads.carried_moment_Nm.abs().maxCoeff() : 0;
    if (most <= 0.01 * loads.carried_moment_scale_Nm) return "";
    return fmt::format(
        "pitch is off: {} stresses contain a guide couple of {:.4g} N m, {:.2g} % of the moments on it",
        body.name, most, 100 * most / loads.carried_moment_scale_Nm);
  }
};

}  // namespace

BodyLoads distribute_chamber(const kinetics::LoadHistory& loads, const kinetics::VibratoryMill& mill,
                             const LoadedBody& body, const ChamberLoading& loading) {
  if (!loads.has_resultant(bore))
    throw StageRefused("the load history of convention \"" + loads.convention +
                       "\" has no closed loads for a chamber: analyse bodies under \"consistent\"");
  const Index n = loads.n_instants();
  const auto& on_bore = loads.resultant(bore);
  LoadCollector collector(body, loads.effects, n, on_bore.total.topRows<2>().abs().maxCoeff());
  for (const auto& part : on_bore.contributions) collector.force(bore, part.effect, part.load.topRows<2>());
  for (std::size_t i = 1; i <= mill.springs.size(); ++i) {
    const std::string port = foot(i);
    if (!loads.has_resultant(port)) continue;
    for (const auto& part : loads.resultant(port).contributions)
      collector.force(port, part.effect, part.load.topRows<2>());
  }
  if (loads.has_resultant(wall))
    for (const auto& part : loads.resultant(wall).contributions) {
      collector.force(wall, part.effect, part.load.topRows<2>());
      collector.torque(wall, part.effect, part.load.row(2).transpose());
    }

  ChamberParts parts(collector, body, loading);
  AccelerationField weight{Array3Xd::Zero(3, n), {}, {}}, inertia = weight;
  weight.translation_m_s2.row(1) = -mill.gravity_m_s2;
  inertia.translation_m_s2.topRows<2>() = inertial_translation(loads, mill.eccentricity_m);
  const auto accelerate = [&](const char* name, auto part, const AccelerationField& field) {
    if (contains(loading.effects, name)) (parts.*part)(collector.effect(name), field);
  };
  accelerate(effect_name::gravity_structure, &ChamberParts::structure, weight);
  accelerate(effect_name::gravity_exciter, &ChamberParts::exciter, weight);
  accelerate(effect_name::structure_inertia, &ChamberParts::structure, inertia);
  accelerate(effect_name::exciter_inertia, &ChamberParts::exciter, inertia);
  if (contains(loading.effects, effect_name::pitch))
    parts.all(effect_name::pitch, {{}, -loads.quantity("theta_ddot").values, {}});

  ArrayXd carried;
  const double scale = collector.moment_scale_Nm();
  if (!contains(loading.effects, effect_name::pitch)) {
    carried = -collector.sum().row(5).transpose();
    if (loading.guide == PitchGuide::body)
      guide_by_body(parts, carried);
    else
      guide_by_feet(collector, body, carried);
  }
  collector.react_tilt(bore);
  collector.pressure(bore);
  collector.pressure(wall);
  auto result = collector.finish();
  result.carried_moment_Nm = carried;
  result.carried_moment_scale_Nm = scale;
  return result;
}

const LoadMaker& chamber_loads() {
  static const ChamberLoads loads;
  return loads;
}

}  // namespace pipelines
