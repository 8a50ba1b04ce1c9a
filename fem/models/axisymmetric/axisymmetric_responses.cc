#include "fem/models/axisymmetric/axisymmetric_responses.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "fem/base/common/parallel.h"
#include "fem/base/values/constants.h"
#include "fem/models/axisymmetric/harmonic_loads.h"
#include "fem/models/axisymmetric/harmonic_sections.h"
#include "fem/models/axisymmetric/harmonic_solver.h"
#include "fem/models/axisymmetric/harmonic_strain.h"
#include "fem/models/axisymmetric/revolved_nodes.h"

namespace fem {
namespace {

/// One harmonic of all channels that have it.
struct Harmonic {
  int m;
  std::vector<HarmonicPart> parts;
  Eigen::MatrixXd force;  // balanced; a column per part
  Eigen::MatrixXd displacement;
  Amplitudes amplitudes;
};

std::vector<Harmonic> load_harmonics(const MeridianGrid& grid, const HarmonicLoads& load_of,
                                     const std::vector<UnitLoad>& loads, UnitResponses& r) {
  struct Columns {
    std::vector<HarmonicPart> parts;
    std::vector<Eigen::VectorXd> force;
  };
  std::map<int, Columns> by_harmonic;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    auto forces = load_of(loads[k]);
    r.channels.push_back(loads[k].channel);
    r.resultants.push_back(load_of.resultant(forces));
    for (auto& [m, turned, force] : forces) {
      const double applied = force.norm();
      load_of.balance(m, force);
      // A uniform acceleration is what balances a load: nothing but rounding is left of it.
      if (!(force.norm() > 1e-12 * applied)) continue;
      by_harmonic[m].parts.push_back({k, turned});
      by_harmonic[m].force.push_back(std::move(force));
    }
  }
  std::vector<Harmonic> harmonics;
  for (auto& [m, columns] : by_harmonic) {
    Eigen::MatrixXd force(3 * grid.n_nodes(), columns.force.size());
    for (std::size_t k = 0; k < columns.force.size(); ++k) force.col(Eigen::Index(k)) = columns.force[k];
    harmonics.push_back({m, std::move(columns.parts), std::move(force), {}, {}});
  }
  return harmonics;
}

std::vector<Harmonic> solve_harmonics(const MeridianGrid& grid, const MeridianBody& body,
                                      const std::vector<UnitLoad>& loads, UnitResponses& r) {
  const HarmonicLoads load_of(grid, body);
  auto harmonics = load_harmonics(grid, load_of, loads, r);
  const HarmonicPattern pattern(grid);
  std::vector<double> residual(harmonics.size(), 0);
  const SerialBlas serial;  // the harmonics share the threads
  // A solver each for a few of the harmonics: what it finds out about the factor's shape is worth keeping.
  constexpr std::size_t most_solvers = 4;
  const std::size_t n_solvers = std::min(most_solvers, harmonics.size());
  parallel_for(n_solvers, 1, [&](std::size_t begin, std::size_t end) {
    const SerialOpenMp alone;
    for (std::size_t s = begin; s < end; ++s) {
      HarmonicSolver solver(grid, pattern, body.material);
      for (std::size_t i = s; i < harmonics.size(); i += n_solvers) {
        auto& harmonic = harmonics[i];
        harmonic.displacement = solver.solve(harmonic.m, harmonic.force, residual[i]);
        load_of.remove_motion(harmonic.m, harmonic.displacement);
        harmonic.amplitudes = result_amplitudes(grid, body.material, harmonic.m, harmonic.displacement);
      }
    }
  });
  for (const double own : residual) r.residual = std::max(r.residual, own);
  r.n_dofs = harmonics.size() * 3 * std::size_t(grid.n_nodes());
  return harmonics;
}

/// Adds amplitudes a (U, V, W, rr, tt, zz, rz, rt, tz) times the factors of their cosine and sine at an angle
/// to displacement u and stress s.
void add_at_angle(const double* a, double even, double odd, double cos, double sin, double* u, double* s) {
  const double ur = even * a[0], ut = odd * a[1];
  u[0] += ur * cos - ut * sin;
  u[1] += ur * sin + ut * cos;
  u[2] += even * a[2];
  const double rr = even * a[3], tt = even * a[4], rz = even * a[6], rt = odd * a[7], tz = odd * a[8];
  s[0] += rr * cos * cos + tt * sin * sin - 2 * rt * cos * sin;
  s[1] += rr * sin * sin + tt * cos * cos + 2 * rt * cos * sin;
  s[2] += even * a[5];
  s[3] += (rr - tt) * cos * sin + rt * (cos * cos - sin * sin);
  s[4] += rz * sin + tz * cos;
  s[5] += rz * cos - tz * sin;
}

/// All channels at one node.
void add_at_node(const std::vector<Harmonic>& harmonics, Eigen::Index point, double angle, std::size_t node,
                 UnitResponses& r) {
  const std::size_t n_channels = r.channels.size();
  const double cos = std::cos(angle), sin = std::sin(angle);
  for (const auto& harmonic : harmonics) {
    const double cos_m = std::cos(harmonic.m * angle), sin_m = std::sin(harmonic.m * angle);
    const double* amplitudes = harmonic.amplitudes.row(point).data();
    for (const auto& [channel, turned] : harmonic.parts) {
      const double even = turned ? sin_m : cos_m;
      const double odd = harmonic.m == 0 ? 1 : turned ? -cos_m : sin_m;
      const std::size_t at = node * n_channels + channel;
      add_at_angle(amplitudes, even, odd, cos, sin, &r.displacement_m[3 * at], &r.stress_Pa[6 * at]);
      amplitudes += 9;
    }
  }
}

void turn_around(const std::vector<Harmonic>& harmonics, RevolvedNodes revolved, int n_angles,
                 UnitResponses& r) {
  r.nodes = std::move(revolved.nodes);
  r.displacement_m.assign(r.nodes.n * r.channels.size() * 3, 0);
  r.stress_Pa.assign(r.nodes.n * r.channels.size() * 6, 0);
  parallel_for(revolved.first.size() - 1, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t point = begin; point < end; ++point)
      for (std::size_t j = 0; j < revolved.n_at(point); ++j)
        add_at_node(harmonics, Eigen::Index(point), 2 * pi * double(j) / n_angles, revolved.first[point] + j,
                    r);
  });
}

}  // namespace

UnitResponses axisymmetric_responses(const MeridianBody& body, const std::vector<UnitLoad>& loads,
                                     const std::vector<SectionPlane>& planes) {
  if (loads.empty()) throw std::invalid_argument("no unit loads: nothing to solve");
  if (body.n_angles < 4 || body.n_angles % 2 != 0)
    throw std::invalid_argument(std::to_string(body.n_angles) + " angles: must be even, 4 or more");
  const MeridianGrid grid = meridian_grid(body, planes);
  UnitResponses r;
  r.solver.reason = "axisymmetric harmonics";
  const auto harmonics = solve_harmonics(grid, body, loads, r);
  const HarmonicSections sections(grid, body, planes, r);
  for (const auto& harmonic : harmonics)
    sections.add(harmonic.m, harmonic.parts, harmonic.displacement, harmonic.amplitudes, r);
  turn_around(harmonics, revolve(grid, body.n_angles), body.n_angles, r);
  return r;
}

MassProperties axisymmetric_masses(const MeridianBody& body) {
  const MeridianGrid grid = meridian_grid(body);
  const double density = body.material.density_kg_m3;
  MassProperties masses;
  for (const auto& cell : grid.cell_points)
    for (const auto& p : cell) {
      const double volume_m3 = 2 * pi * p.r_m * p.weight;
      masses.volume_m3 += volume_m3;
      masses.first_moment_kg_m[2] += density * volume_m3 * p.z_m;
      const double across = density * volume_m3 * p.r_m * p.r_m / 2;
      masses.second_moments_kg_m2[0] += across;
      masses.second_moments_kg_m2[1] += across;
      masses.second_moments_kg_m2[2] += density * volume_m3 * p.z_m * p.z_m;
    }
  masses.mass_kg = density * masses.volume_m3;
  for (const auto& c : body.eccentric) {  // the whole disc is moved, the bore in it stays
    const double length_m = c.end_m - c.begin_m, x = c.axis_x_m, y = c.axis_y_m;
    const double mass_kg = density * pi * c.radius_m * c.radius_m * length_m;
    const double z = (c.begin_m + c.end_m) / 2;
    masses.first_moment_kg_m[0] += mass_kg * x;
    masses.first_moment_kg_m[1] += mass_kg * y;
    auto& second = masses.second_moments_kg_m2;
    second[0] += mass_kg * x * x;
    second[1] += mass_kg * y * y;
    second[3] += mass_kg * x * y;
    second[4] += mass_kg * y * z;
    second[5] += mass_kg * x * z;
  }
  return masses;
}

}  // namespace fem
