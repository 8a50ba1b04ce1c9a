#include "fem/models/beam/beam_statics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/base/common/dense_algebra.h"
#include "fem/equations/loads/axial_profile.h"
#include "fem/equations/loads/surface_loads.h"

namespace fem {
namespace {

using Component = SurfaceResultant::Component;
using Eigen::Index;
constexpr int points = BeamInterval::points;

/// A force through a point and a couple, about the origin.
Wrench6 about_origin(const Eigen::Vector3d& force, const Eigen::Vector3d& at, const Eigen::Vector3d& couple) {
  Wrench6 w;
  w << force, couple + at.cross(force);
  return w;
}

/// Force and moment per length of a seat's unit resultant at zeta in [-1, 1] of its half length.
Wrench6 on_seat(const SurfaceResultant& load, double z_m) {
  const auto& s = load.surface;
  const double half = s.length_m / 2, zeta = (z_m - s.centre_m[2]) / half;
  const double tapered = 0.75 * (1 - zeta * zeta) / half;
  const AxialProfile profile(s);
  const double straight =
      (profile(zeta * half) / 2 - 1.5 * profile.first_moment() * zeta) / half;  // without its couple
  const double tilting = 1.5 * zeta / (half * half);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = Eigen::Vector3d::Zero();
  switch (load.component) {
    case Component::fx:
      force[0] = straight;
      break;
    case Component::fy:
      force[1] = straight;
      break;
    case Component::fz:
      force[2] = tapered;
      break;
    case Component::mx:
      force[1] = -tilting;
      break;
    case Component::my:
      force[0] = tilting;
      break;
    case Component::torque:
      couple[2] = tapered;
      break;
  }
  return about_origin(force, {s.centre_m[0], s.centre_m[1], z_m}, couple);
}

Wrench6 on_face(const SurfaceResultant& load) {
  Wrench6 unit = Wrench6::Zero();
  unit[int(load.component)] = 1;
  const auto& c = load.surface.centre_m;
  return about_origin(unit.head<3>(), {c[0], c[1], c[2]}, unit.tail<3>());
}

}  // namespace

// Interval after interval, by parabolas through three of its points.
template <typename PerLength>
WrenchAlong BeamLine::integral(const PerLength& per_length) const {
  constexpr int n_pairs = (points - 1) / 2;  // the number of points is odd
  WrenchAlong sum(6, Index(intervals_.size()) * points);
  Wrench6 total = Wrench6::Zero();
  for (std::size_t k = 0; k < intervals_.size(); ++k) {
    const Index first = Index(k) * points;
    const double h = (intervals_[k].end_m - intervals_[k].begin_m) / n_pairs;
    sum.col(first) = total;
    for (Index i = first; i + 2 < first + points; i += 2) {
      const Wrench6 a = per_length(k, i), b = per_length(k, i + 1), c = per_length(k, i + 2);
      sum.col(i + 1) = sum.col(i) + h / 24 * (5 * a + 8 * b - c);
      sum.col(i + 2) = sum.col(i) + h / 6 * (a + 4 * b + c);
    }
    total = sum.col(first + points - 1);
  }
  return sum;
}

double BeamLine::z_m(std::size_t interval, Index column) const {
  return intervals_[interval].z_m(int(column % points));
}

BeamLine::BeamLine(const BeamShaft& shaft, const std::vector<UnitLoad>& loads, std::vector<double> breaks_m)
    : shaft_(&shaft) {
  for (const auto& segment : shaft.segments)
    sections_.push_back(beam_section(segment, shaft.material.poisson_ratio));
  for (const auto& load : loads)
    if (const auto* s = surface_of(load)) {
      const auto n = std::max<std::size_t>(s->axial_profile.size(), 2) - 1;
      for (std::size_t i = 0; i <= n; ++i)
        breaks_m.push_back(s->centre_m[2] + s->length_m * (double(i) / double(n) - 0.5));
    }
  const double tiny = 1e-9 * (shaft.segments.back().end_m - shaft.segments.front().begin_m);
  std::sort(breaks_m.begin(), breaks_m.end());
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    double from = shaft.segments[i].begin_m;
    const double end = shaft.segments[i].end_m;
    for (const double z : breaks_m)
      if (z > from + tiny && z < end - tiny) {
        intervals_.push_back({from, z, i});
        from = z;
      }
    intervals_.push_back({from, end, i});
  }
  mass_columns_.resize(6, 6 * Index(intervals_.size()) * points);
  for (std::size_t k = 0; k < intervals_.size(); ++k)
    for (int i = 0; i < points; ++i)
      mass_columns_.middleCols<6>(6 * (Index(k) * points + i)) =
          section(k).mass_per_length(shaft.material.density_kg_m3, intervals_[k].z_m(i));
  for (int c = 0; c < 6; ++c) {
    WrenchAlong column(6, Index(intervals_.size()) * points);
    for (Index i = 0; i < column.cols(); ++i) column.col(i) = mass_columns_.col(6 * i + c);
    mass_.col(c) = sum(column);
  }
}

Eigen::Index BeamLine::column_at(std::size_t segment, double z_m) const {
  const double tiny = 1e-8 * (shaft_->segments.back().end_m - shaft_->segments.front().begin_m);
  for (std::size_t k = 0; k < intervals_.size(); ++k) {
    if (intervals_[k].segment != segment) continue;
    if (std::abs(intervals_[k].begin_m - z_m) < tiny) return Index(k) * points;
    if (std::abs(intervals_[k].end_m - z_m) < tiny) return Index(k) * points + points - 1;
  }
  throw std::logic_error("no interval of the beam begins or ends at z = " + std::to_string(z_m) + " m");
}

Wrench6 BeamLine::sum(const WrenchAlong& per_length) const {
  return integral([&](std::size_t, Index i) { return per_length.col(i); }).rightCols<1>();
}

Wrench6 BeamLine::density(const UnitLoad& load, const BeamInterval& interval, double z_m) const {
  if (const auto* body = std::get_if<BodyForce>(&load.shape)) {
    const auto& s = sections_[interval.segment];
    const auto mass = s.mass_per_length(shaft_->material.density_kg_m3, z_m);
    switch (body->field) {
      case BodyForce::Field::translation_x:
        return mass.col(0);
      case BodyForce::Field::translation_y:
        return mass.col(1);
      case BodyForce::Field::translation_z:
        return mass.col(2);
      case BodyForce::Field::rotation:
        return mass.col(5);
      case BodyForce::Field::spin: {
        const Eigen::Vector2d pull = shaft_->material.density_kg_m3 * s.area_m2 * s.centroid_m;
        return about_origin({pull[0], pull[1], 0}, {0, 0, z_m}, Eigen::Vector3d::Zero());
      }
    }
  }
  const auto* resultant = std::get_if<SurfaceResultant>(&load.shape);
  if (!resultant || resultant->surface.kind == LoadSurface::Kind::face) return Wrench6::Zero();
  const double middle = (interval.begin_m + interval.end_m) / 2 - resultant->surface.centre_m[2];
  if (std::abs(middle) > resultant->surface.length_m / 2) return Wrench6::Zero();
  return on_seat(*resultant, z_m);
}

WrenchAlong BeamLine::below(const UnitLoad& load) const {
  const auto* resultant = std::get_if<SurfaceResultant>(&load.shape);
  const bool is_face = resultant && resultant->surface.kind == LoadSurface::Kind::face;
  WrenchAlong along =
      integral([&](std::size_t k, Index i) { return density(load, intervals_[k], z_m(k, i)); });
  for (std::size_t k = 0; is_face && k < intervals_.size(); ++k)
    if ((intervals_[k].begin_m + intervals_[k].end_m) / 2 > resultant->surface.centre_m[2])
      along.middleCols<points>(Index(k) * points).colwise() += on_face(*resultant);
  return along;
}

Wrench6 BeamLine::total(const UnitLoad& load) const {
  const auto* resultant = std::get_if<SurfaceResultant>(&load.shape);
  if (resultant && resultant->surface.kind == LoadSurface::Kind::face) return on_face(*resultant);
  return below(load).rightCols<1>();
}

WrenchAlong BeamLine::internal(const UnitLoad& load) const {
  WrenchAlong along = below(load);
  const Wrench6 acceleration = -solve_symmetric(mass_, total(load));
  const WrenchAlong balancing = integral(
      [&](std::size_t, Index i) -> Wrench6 { return mass_columns_.middleCols<6>(6 * i) * acceleration; });
  for (Index i = 0; i < along.cols(); ++i) {
    auto w = along.col(i);
    w = -(w + balancing.col(i)).eval();
    const double z = z_m(std::size_t(i / points), i);
    w[3] += z * w[1];
    w[4] -= z * w[0];
  }
  return along;
}

WrenchAlong BeamLine::motion(const WrenchAlong& internal) const {
  WrenchAlong motion = WrenchAlong::Zero(6, internal.cols());
  // Rotations first: translations follow from them.
  for (int pass = 0; pass < 2; ++pass)
    motion = integral([&](std::size_t k, Index i) {
      return strain_of_section(section(k), internal.col(i), motion.col(i), shaft_->material);
    });
  // About the origin as the mass matrix has it: U(0) = U(z) + Theta x (0 - z e_z).
  WrenchAlong momentum(6, internal.cols());
  const auto to_origin = [](const Wrench6& m, double z) {
    Wrench6 o = m;
    o[0] -= z * m[4];
    o[1] += z * m[3];
    return o;
  };
  const auto z_of = [&](Index i) { return z_m(std::size_t(i / points), i); };
  for (Index i = 0; i < internal.cols(); ++i)
    momentum.col(i) = mass_columns_.middleCols<6>(6 * i) * to_origin(motion.col(i), z_of(i));
  const Wrench6 rigid = solve_symmetric(mass_, sum(momentum));
  for (Index i = 0; i < internal.cols(); ++i) motion.col(i) -= to_origin(rigid, -z_of(i));
  return motion;
}

}  // namespace fem
