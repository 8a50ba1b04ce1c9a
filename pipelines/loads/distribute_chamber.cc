#include <algorithm>
#include <cmath>

#include "pipelines/common/errors.h"
#include "pipelines/common/name_lists.h"
#include "pipelines/loads/distribute.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

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
class Chamber {
public:
  Chamber(LoadCollector& collector, const LoadedBody& body, const ChamberOptions& options)
      : book_(collector), body_(body), options_(options) {}

  void structure(const std::string& effect, const AccelerationField& field) {
    book_.accelerate(body_.region("structure"), effect, field);
    for (const auto& mass : options_.structure) book_.accelerate(mass, effect, field);
  }
  void exciter(const std::string& effect, const AccelerationField& field) {
    for (const auto& region : body_.regions)
      if (region.name == "exciter") book_.accelerate(region, effect, field);
    for (const auto& mass : options_.exciter) book_.accelerate(mass, effect, field);
  }
  void all(const std::string& effect, const AccelerationField& field) {
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
    for (const auto* list : {&options_.structure, &options_.exciter})
      for (const auto& m : *list) {
        mass += m.mass_kg;
        sx += m.first_moment_kg_m[0];
        sy += m.first_moment_kg_m[1];
        polar += m.polar_inertia_kg_m2;
      }
    return {mass, sx / mass, sy / mass, polar - (sx * sx + sy * sy) / mass};
  }

private:
  LoadCollector& book_;
  const LoadedBody& body_;
  const ChamberOptions& options_;
};

/// The couple that holds the attitude: a rotation about the mass centre has no resultant force.
void guide_by_body(Chamber& chamber, const ArrayXd& couple_Nm) {
  const auto inertia = chamber.about_mass_centre();
  const ArrayXd angular = couple_Nm / inertia.polar_kg_m2;
  AccelerationField field{Array3Xd::Zero(3, couple_Nm.size()), angular, {}};
  field.translation_m_s2.row(0) = (inertia.y_m * angular).transpose();  // angular z x (p - p_G)
  field.translation_m_s2.row(1) = (-inertia.x_m * angular).transpose();
  chamber.all("pitch_guide", field);
}

void guide_by_feet(LoadCollector& collector, const LoadedBody& body, const ArrayXd& couple_Nm) {
  std::array<double, 2> x{};
  for (const auto& port : body.ports)
    for (std::size_t i = 0; i < 2; ++i)
      if (port.name == "spring_foot_" + std::to_string(i + 1)) x[i] = port.axis_x_m;
  Array2Xd force = Array2Xd::Zero(2, couple_Nm.size());
  force.row(1) = (couple_Nm / (x[1] - x[0])).transpose();
  collector.force("spring_foot_2", "pitch_guide", force);
  collector.force("spring_foot_1", "pitch_guide", -force);
}

}  // namespace

BodyLoads distribute_chamber(const kinetics::LoadHistory& loads, const kinetics::VibratoryMill& mill,
                             const LoadedBody& body, const ChamberOptions& options) {
  if (!loads.has_resultant("housing_bore"))
    throw StageRefused("the load history of convention \"" + loads.convention +
                       "\" has no closed loads for a chamber: analyse bodies under \"consistent\"");
  const Index n = loads.n_instants();
  const auto& bore = loads.resultant("housing_bore");
  LoadCollector collector(body, loads.effects, n, bore.total.topRows<2>().abs().maxCoeff());
  for (const auto& part : bore.contributions)
    collector.force("housing_bore", part.effect, part.load.topRows<2>());
  for (std::size_t i = 1; i <= mill.springs.size(); ++i) {
    const std::string foot = "spring_foot_" + std::to_string(i);
    if (!loads.has_resultant(foot)) continue;
    for (const auto& part : loads.resultant(foot).contributions)
      collector.force(foot, part.effect, part.load.topRows<2>());
  }
  if (loads.has_resultant("inner_wall"))
    for (const auto& part : loads.resultant("inner_wall").contributions) {
      collector.force("inner_wall", part.effect, part.load.topRows<2>());
      collector.torque("inner_wall", part.effect, part.load.row(2).transpose());
    }

  Chamber chamber(collector, body, options);
  AccelerationField weight{Array3Xd::Zero(3, n), {}, {}}, inertia = weight;
  weight.translation_m_s2.row(1) = -mill.gravity_m_s2;
  inertia.translation_m_s2.topRows<2>() = inertial_translation(loads, mill.eccentricity_m);
  if (contains(options.effects, "gravity_structure")) chamber.structure("gravity_structure", weight);
  if (contains(options.effects, "gravity_exciter")) chamber.exciter("gravity_exciter", weight);
  if (contains(options.effects, "structure_inertia")) chamber.structure("structure_inertia", inertia);
  if (contains(options.effects, "exciter_inertia")) chamber.exciter("exciter_inertia", inertia);
  if (contains(options.effects, "pitch"))
    chamber.all("pitch", {{}, -loads.quantity("theta_ddot").values, {}});

  ArrayXd carried;
  const double scale = collector.moment_scale_Nm();
  if (!contains(options.effects, "pitch")) {
    carried = -collector.sum().row(5).transpose();
    if (options.guide == PitchGuide::body)
      guide_by_body(chamber, carried);
    else
      guide_by_feet(collector, body, carried);
  }
  collector.react_tilt("housing_bore");
  collector.pressure("housing_bore");
  collector.pressure("inner_wall");
  auto result = collector.finish();
  result.carried_moment_Nm = carried;
  result.carried_moment_scale_Nm = scale;
  return result;
}

}  // namespace pipelines
