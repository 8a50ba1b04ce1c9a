#include "pipelines/judge/life/nominal_fatigue.h"

#include <algorithm>
#include <cmath>

#include "fem/models/beam/fillet_factors.h"
#include "pipelines/base/common/constants.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;

/// Directions that the bending moment is looked at in: off by half a degree, an amplitude is 4e-5 less.
constexpr int n_directions = 180;

double half_range(const ArrayXd& values) {
  return (values.maxCoeff() - values.minCoeff()) / 2;
}
double middle(const ArrayXd& values) {
  return (values.maxCoeff() + values.minCoeff()) / 2;
}

bool is_din_fillet(const meshes::Shaft& shaft, std::size_t i) {
  return shaft.fillets_m[i] > 0 && !(shaft.segments[i].bore_m > 0) && !(shaft.segments[i + 1].bore_m > 0);
}

}  // namespace

const SectionResult* nearest_section(const Diagrams& diagrams, const std::string& segment, double z_m) {
  const SectionResult* nearest = nullptr;
  for (const auto& section : diagrams.sections)
    if (section.plane.segment == segment &&
        (nearest == nullptr || std::abs(section.plane.z_m - z_m) < std::abs(nearest->plane.z_m - z_m)))
      nearest = &section;
  return nearest;
}

bool is_din_steel(const GroupConstants& group) {
  return !group.is_cast && group.group != MaterialGroup::wrought_aluminium;
}

bool has_din_fillet(const meshes::Shaft& shaft) {
  for (std::size_t i = 0; i < shaft.fillets_m.size(); ++i)
    if (is_din_fillet(shaft, i)) return true;
  return false;
}

DinLoad nominal_load(const SectionResult& section) {
  const auto& at = section.by_statics;
  const auto& plane = section.plane;
  const double d = 2 * plane.radius_m, area_m2 = pi * d * d / 4, bending_m3 = pi * d * d * d / 32;
  const ArrayXd normal = at.row(2).transpose();
  const ArrayXd mx = at.row(3).transpose() - plane.axis_y_m * normal;
  const ArrayXd my = at.row(4).transpose() + plane.axis_x_m * normal;
  const ArrayXd torque = at.row(5).transpose() -
                         (plane.axis_x_m * at.row(1).transpose() - plane.axis_y_m * at.row(0).transpose());
  const auto along = [&](int i) -> ArrayXd {
    const double angle = pi * i / n_directions;
    return std::cos(angle) * mx + std::sin(angle) * my;
  };
  double amplitude_Nm = 0, mean_Nm = 0;
  for (int i = 0; i < n_directions; ++i) {
    const ArrayXd bending = along(i), across = along(i + n_directions / 2);
    amplitude_Nm = std::max(amplitude_Nm, half_range(bending));
    mean_Nm = std::max(mean_Nm, std::hypot(middle(bending), middle(across)));
  }
  DinLoad load;
  load.amplitude_Pa = {half_range(normal) / area_m2, amplitude_Nm / bending_m3,
                       half_range(torque) / (2 * bending_m3)};
  load.mean_Pa = {middle(normal) / area_m2, mean_Nm / bending_m3,
                  std::abs(middle(torque)) / (2 * bending_m3)};
  return load;
}

DinTriple own_shape_factor(const DinTriple& published, const DinTriple& nominal_Pa, double local_Pa) {
  const double direct_Pa = published.tension * nominal_Pa.tension + published.bending * nominal_Pa.bending;
  const double by_fits_Pa = std::hypot(direct_Pa, std::sqrt(3.0) * published.torsion * nominal_Pa.torsion);
  const double level = by_fits_Pa > 0 && local_Pa >= 0 ? local_Pa / by_fits_Pa : 1;
  return {std::max(1.0, level * published.tension), std::max(1.0, level * published.bending),
          std::max(1.0, level * published.torsion)};
}

DinTriple din_shoulder_gradient_1_m(double small_m, double large_m, double fillet_m) {
  const double depth_m = (large_m - small_m) / 2;
  const double phi = small_m / large_m > 0.67 ? 1 / (4 * std::sqrt(depth_m / fillet_m) + 2) : 0;
  const double direct = 2.3 * (1 + phi) / fillet_m;
  return {direct, direct, 1.15 / fillet_m};
}

std::vector<NominalFatigue> din_743_of_fillets(
    const Judged& analysis, const ChannelHistory& loads,
    const std::function<LocalAmplitude(const std::string&)>& local_amplitude) {
  std::vector<NominalFatigue> result;
  const ShaftShape* shaft = analysis.scene.shaft();
  if (shaft == nullptr || !analysis.diagrams) return result;
  const auto& scene = analysis.scene.fatigue.value();
  const auto& segments = shaft->geometry.segments;
  for (std::size_t i = 0; i < shaft->geometry.fillets_m.size(); ++i) {
    const double fillet_m = shaft->geometry.fillets_m[i];
    const auto &left = segments[i], &right = segments[i + 1];
    if (!is_din_fillet(shaft->geometry, i)) continue;
    const auto& thin = left.diameter_m < right.diameter_m ? left : right;
    const auto& thick = &thin == &left ? right : left;
    const auto* section = nearest_section(*analysis.diagrams, thin.name, left.end_m);
    if (section == nullptr) continue;
    NominalFatigue own;
    own.fillet = "fillet " + left.name + "/" + right.name;
    own.z_m = section->plane.z_m;
    own.diameter_m = thin.diameter_m;
    SectionResult of_loads;
    of_loads.plane = section->plane;
    of_loads.by_statics = statics_over_the_cycle(analysis.loads.unit_loads, loads, shaft->geometry,
                                                 analysis.scene.material.density_kg_m3, section->plane.z_m);
    own.load = nominal_load(of_loads);
    const auto published = fem::fillet_factors(thin.diameter_m, thick.diameter_m, fillet_m);
    const LocalAmplitude local = local_amplitude(own.fillet);
    own.error_share = local.error_share;
    const auto shape_factor = [&](double local_Pa) {
      return own_shape_factor({published.tension, published.bending, published.torsion},
                              own.load.amplitude_Pa, local_Pa);
    };
    own.shape_factor = shape_factor(local.value_Pa);
    DinShaft din;
    din.tensile_strength_Pa = scene.material.tensile_strength_Pa;
    din.yield_strength_Pa = scene.material.yield_strength_Pa;
    din.diameter_m = thin.diameter_m;
    din.roughness_m = scene.roughness_m;
    din.treatment_factor = scene.treatment;
    din.shape_factor = own.shape_factor;
    din.gradient_1_m = din_shoulder_gradient_1_m(thin.diameter_m, thick.diameter_m, fillet_m);
    own.safety = din_743_safety(din, own.load);
    if (std::isfinite(local.error_share)) {
      din.shape_factor = shape_factor((1 + local.error_share) * local.value_Pa);
      own.least_safety = din_743_safety(din, own.load).fatigue;
    }
    result.push_back(std::move(own));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.safety.fatigue < b.safety.fatigue; });
  return result;
}

}  // namespace pipelines
