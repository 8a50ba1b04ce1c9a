#include "fem/models/beam/beam_responses.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fem/base/values/constants.h"
#include "fem/models/beam/beam_statics.h"
#include "fem/models/beam/fillet_factors.h"

namespace fem {
namespace {

const double peak_angle = pi / 12;  // up the arc of a fillet

/// A fillet seen from its thinner segment.
struct Shoulder {
  const BeamSegment *thin, *thick;
  std::size_t thin_index, thick_index;
  double direction;  // +1: the thicker segment has the larger z
  double z_m, fillet_m;

  /// Height of the step at an angle: from the thin circle to the thick one, along the thin one's radius.
  double step_m(const Eigen::Vector2d& radius) const {
    const Eigen::Vector2d offset(thick->axis_x_m - thin->axis_x_m, thick->axis_y_m - thin->axis_y_m);
    const double along = offset.dot(radius);
    return along +
           std::sqrt(
               std::max(0.0, thick->radius_m * thick->radius_m + along * along - offset.squaredNorm())) -
           thin->radius_m;
  }
  FilletFactors factors(const Eigen::Vector2d& radius) const {
    const double step = std::max(step_m(radius), 1e-3 * thin->radius_m);
    return fillet_factors(2 * thin->radius_m, 2 * (thin->radius_m + step), fillet_m);
  }
};

/// A circle of nodes and where its stress comes from.
struct Circle {
  double z_m, radius_m;
  std::size_t segment;
  double arc_angle = 0;                // at which the surface climbs towards `direction`
  const Shoulder* shoulder = nullptr;  // whose factors count
};

void require_sizes(const BeamShaft& shaft) {
  const auto& segments = shaft.segments;
  if (segments.empty() || shaft.n_angles < 4 || shaft.n_angles % 2 != 0)
    throw std::invalid_argument("beam: needs at least one segment and an even number of angles from 4");
  const double tiny = 1e-9 * (segments.back().end_m - segments.front().begin_m);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto& s = segments[i];
    const bool touches = i == 0 || std::abs(s.begin_m - segments[i - 1].end_m) <= tiny;
    if (!(s.end_m > s.begin_m && s.radius_m > s.bore_radius_m && s.bore_radius_m >= 0) || !touches)
      throw std::invalid_argument(
          "beam segment " + std::to_string(i) + " from z = " + std::to_string(s.begin_m) + " to " +
          std::to_string(s.end_m) + " m: needs a length, a wall, and no gap before it");
  }
}

std::vector<Shoulder> shoulders_of(const BeamShaft& shaft) {
  std::vector<Shoulder> shoulders;
  for (const auto& fillet : shaft.fillets) {
    const auto i = fillet.junction;
    if (i + 1 >= shaft.segments.size() || shaft.segments[i].radius_m == shaft.segments[i + 1].radius_m ||
        !(fillet.radius_m > 0))
      throw std::invalid_argument("beam: the fillet at junction " + std::to_string(i) +
                                  " needs a step and a positive radius");
    const bool rises = shaft.segments[i + 1].radius_m > shaft.segments[i].radius_m;
    const std::size_t thin = rises ? i : i + 1, thick = rises ? i + 1 : i;
    shoulders.push_back({&shaft.segments[thin], &shaft.segments[thick], thin, thick, rises ? 1.0 : -1.0,
                         shaft.segments[i].end_m, fillet.radius_m});
  }
  return shoulders;
}

/// Three circles that make one ring of faces, ascending in z.
struct Band {
  std::array<Circle, 3> circles;
  int boundary_id;
};

std::vector<Band> bands_of(const BeamShaft& shaft, const std::vector<Shoulder>& shoulders) {
  std::vector<Band> bands;
  for (const auto& piece : shaft.pieces) {
    const double r = shaft.segments.at(piece.segment).radius_m;
    bands.push_back({{{{piece.begin_m, r, piece.segment},
                       {(piece.begin_m + piece.end_m) / 2, r, piece.segment},
                       {piece.end_m, r, piece.segment}}},
                     piece.boundary_id});
  }
  for (std::size_t i = 0; i < shoulders.size(); ++i) {
    const auto& s = shoulders[i];
    const auto on_arc = [&](double angle, std::size_t segment, const Shoulder* shoulder) -> Circle {
      return {s.z_m - s.direction * s.fillet_m * (1 - std::sin(angle)),
              s.thin->radius_m + s.fillet_m * (1 - std::cos(angle)), segment, angle, shoulder};
    };
    Band band{{{on_arc(0, s.thin_index, nullptr), on_arc(peak_angle, s.thin_index, &s),
                on_arc(pi / 2, s.thick_index, nullptr)}},
              shaft.fillets[i].boundary_id};
    if (s.direction < 0) std::swap(band.circles[0], band.circles[2]);
    bands.push_back(band);
  }
  return bands;
}

Eigen::Vector2d at_angle(const BeamShaft& shaft, int j) {
  const double angle = 2 * pi * j / shaft.n_angles;
  return {std::cos(angle), std::sin(angle)};
}

/// Axis of the circle: of the thinner segment on a fillet.
Eigen::Vector2d axis_of(const BeamShaft& shaft, const Band& band, const std::vector<Shoulder>& shoulders,
                        std::size_t index) {
  const auto& s = index < shaft.pieces.size() ? shaft.segments[band.circles[0].segment]
                                              : *shoulders[index - shaft.pieces.size()].thin;
  return {s.axis_x_m, s.axis_y_m};
}

Nodes nodes_of(const BeamShaft& shaft, const std::vector<Band>& bands,
               const std::vector<Shoulder>& shoulders) {
  Nodes nodes;
  const int n = shaft.n_angles;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const auto first = std::int32_t(nodes.n);
    const Eigen::Vector2d axis = axis_of(shaft, bands[b], shoulders, b);
    for (const auto& circle : bands[b].circles)
      for (int j = 0; j < n; ++j) {
        const Eigen::Vector2d p = axis + circle.radius_m * at_angle(shaft, j);
        nodes.xyz_m.insert(nodes.xyz_m.end(), {p[0], p[1], circle.z_m});
        ++nodes.n;
      }
    const auto node = [&](int circle, int j) { return first + circle * n + j % n; };
    for (int j = 0; j < n; j += 2) {
      nodes.faces.insert(nodes.faces.end(),
                         {node(0, j), node(0, j + 2), node(2, j + 2), node(2, j), node(0, j + 1),
                          node(1, j + 2), node(2, j + 1), node(1, j), node(1, j + 1)});
      nodes.face_boundary_id.push_back(bands[b].boundary_id);
    }
  }
  nodes.volume_m3.assign(nodes.n, 0);
  return nodes;
}

/// Tensor xx, yy, zz, xy, yz, xz of stress along the surface (in the meridian), around it, and shear.
std::array<double, 6> surface_stress(double along_Pa, double around_Pa, double shear_Pa,
                                     const Eigen::Vector3d& along, const Eigen::Vector3d& around) {
  const Eigen::Matrix3d s = along_Pa * along * along.transpose() + around_Pa * around * around.transpose() +
                            shear_Pa * (along * around.transpose() + around * along.transpose());
  return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
}

std::array<double, 6> stress_at(const BeamShaft& shaft, const Circle& circle, const BeamSection& section,
                                const Wrench6& internal, const Eigen::Vector2d& radius,
                                const FilletFactors& k) {
  const auto nominal = nominal_stress(shaft.segments[circle.segment], section, internal, radius);
  const double along = k.tension * nominal.tension_Pa + k.bending * nominal.bending_Pa;
  const double around = shaft.material.poisson_ratio * (along - nominal.tension_Pa - nominal.bending_Pa);
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitZ();
  if (circle.shoulder) {
    const double climb = circle.shoulder->direction * std::sin(circle.arc_angle);
    tangent << climb * radius[0], climb * radius[1], std::cos(circle.arc_angle);
  }
  return surface_stress(along, around, k.torsion * nominal.shear_Pa, tangent, {-radius[1], radius[0], 0});
}

}  // namespace

UnitResponses beam_responses(const BeamShaft& shaft, const std::vector<UnitLoad>& loads) {
  require_sizes(shaft);
  if (loads.empty()) throw std::invalid_argument("no unit loads: nothing to solve");
  const auto shoulders = shoulders_of(shaft);
  const auto bands = bands_of(shaft, shoulders);
  std::vector<double> breaks_m;
  for (const auto& band : bands)
    for (const auto& circle : band.circles) breaks_m.push_back(circle.z_m);
  const BeamLine line(shaft, loads, breaks_m);

  UnitResponses r;
  r.nodes = nodes_of(shaft, bands, shoulders);
  const std::size_t n_channels = loads.size();
  r.displacement_m.resize(r.nodes.n * n_channels * 3);
  r.stress_Pa.resize(r.nodes.n * n_channels * 6);
  r.n_dofs = 6 * line.intervals().size() * BeamInterval::points;
  r.solver.reason = "beam: statics";
  for (std::size_t k = 0; k < n_channels; ++k) {
    const auto& load = loads[k];
    if (const auto* body = std::get_if<BodyForce>(&load.shape); body && !body->volume_ids.empty())
      throw std::invalid_argument("channel " + load.channel + ": a beam has no parts; give no volume groups");
    r.channels.push_back(load.channel);
    const Wrench6 total = line.total(load);
    r.resultants.push_back({total[0], total[1], total[2], total[3], total[4], total[5]});
    const WrenchAlong internal = line.internal(load), motion = line.motion(internal);
    std::size_t node = 0;
    for (const auto& band : bands)
      for (const auto& circle : band.circles) {
        const auto column = line.column_at(circle.segment, circle.z_m);
        const auto& section = line.section(std::size_t(column / BeamInterval::points));
        for (int j = 0; j < shaft.n_angles; ++j, ++node) {
          const Eigen::Vector2d radius = at_angle(shaft, j);
          const auto factors = circle.shoulder ? circle.shoulder->factors(radius) : FilletFactors{};
          const auto s = stress_at(shaft, circle, section, internal.col(column), radius, factors);
          std::copy(s.begin(), s.end(), &r.stress_Pa[(node * n_channels + k) * 6]);
          const Eigen::Vector3d lever(r.nodes.xyz_m[3 * node], r.nodes.xyz_m[3 * node + 1], 0);
          Eigen::Map<Eigen::Vector3d>(&r.displacement_m[(node * n_channels + k) * 3]) =
              motion.col(column).head<3>() + motion.col(column).tail<3>().cross(lever);
        }
      }
  }
  return r;
}

double eccentricity_error(const BeamShaft& shaft) {
  require_sizes(shaft);
  // Solids of eleven random shafts, known to 1 %, had up to 0.22 of the relative change of the height; the
  // factors of steep shoulders have half of that.
  constexpr double by_height = 0.25;
  double error = 0;
  for (const auto& shoulder : shoulders_of(shaft)) {
    const double offset_m = std::hypot(shoulder.thick->axis_x_m - shoulder.thin->axis_x_m,
                                       shoulder.thick->axis_y_m - shoulder.thin->axis_y_m);
    error = std::max(error, by_height * offset_m / (shoulder.thick->radius_m - shoulder.thin->radius_m));
    const double concentric =
        fillet_factors(2 * shoulder.thin->radius_m, 2 * shoulder.thick->radius_m, shoulder.fillet_m).bending;
    for (int j = 0; j < shaft.n_angles; ++j)
      error = std::max(error, std::abs(shoulder.factors(at_angle(shaft, j)).bending / concentric - 1));
  }
  return error < 1e-12 ? 0 : error;
}

double beam_model_error(const BeamShaft& shaft) {
  return fillet_factor_error.bending + eccentricity_error(shaft);
}

}  // namespace fem
