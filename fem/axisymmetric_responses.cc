#include "fem/axisymmetric_responses.h"

#include <cmath>
#include <map>
#include <stdexcept>

#include "fem/constants.h"
#include "fem/harmonic_loads.h"
#include "fem/harmonic_solver.h"
#include "fem/harmonic_strain.h"

namespace fem {
namespace {

/// What one harmonic adds to one channel: nine columns of the harmonic's amplitudes.
struct Part {
  std::size_t channel;
  bool twin;
};
struct Harmonic {
  int m;
  std::vector<Part> parts;
  SurfaceAmplitudes surface;
};

/// Node i of half plane j: i n_angles + j.
Nodes revolved_nodes(const MeridianGrid& grid, int n_angles) {
  Nodes nodes;
  nodes.n = grid.surface.size() * std::size_t(n_angles);
  for (const auto& p : grid.surface)
    for (int j = 0; j < n_angles; ++j) {
      const double angle = 2 * pi * j / n_angles;
      nodes.xyz_m.insert(nodes.xyz_m.end(), {p.r_m * std::cos(angle), p.r_m * std::sin(angle), p.z_m});
    }
  const auto node = [&](int point, int j) { return std::int32_t(point * n_angles + j % n_angles); };
  for (const auto& edge : grid.edges) {
    const auto [a, middle, b] = edge.surface_points;
    for (int j = 0; j < n_angles; j += 2) {
      nodes.faces.insert(nodes.faces.end(),
                         {node(a, j), node(b, j), node(b, j + 2), node(a, j + 2), node(middle, j),
                          node(b, j + 1), node(middle, j + 2), node(a, j + 1), node(middle, j + 1)});
      nodes.face_boundary_id.push_back(edge.boundary_id);
    }
  }
  nodes.volume_m3.assign(nodes.n, 0);
  return nodes;
}

std::vector<Harmonic> solve_harmonics(const MeridianGrid& grid, const MeridianBody& body,
                                      const std::vector<UnitLoad>& loads, UnitResponses& r) {
  const HarmonicLoads load_of(grid, body);
  struct Columns {
    std::vector<Part> parts;
    std::vector<Eigen::VectorXd> force;
  };
  std::map<int, Columns> by_harmonic;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    auto forces = load_of(loads[k]);
    r.channels.push_back(loads[k].channel);
    r.resultants.push_back(load_of.resultant(forces));
    for (auto& [m, twin, force] : forces) {
      const double applied = force.norm();
      load_of.balance(m, force);
      // A uniform acceleration is what balances a load: nothing but rounding is left of it.
      if (!(force.norm() > 1e-12 * applied)) continue;
      by_harmonic[m].parts.push_back({k, twin});
      by_harmonic[m].force.push_back(std::move(force));
    }
  }
  HarmonicSolver solver(grid, body.material);
  std::vector<Harmonic> harmonics;
  for (const auto& [m, columns] : by_harmonic) {
    Eigen::MatrixXd force(3 * grid.n_nodes(), columns.force.size());
    for (std::size_t k = 0; k < columns.force.size(); ++k) force.col(Eigen::Index(k)) = columns.force[k];
    Eigen::MatrixXd displacement = solver.solve(m, force, r.residual);
    load_of.remove_motion(m, displacement);
    harmonics.push_back({m, columns.parts, surface_amplitudes(grid, body.material, m, displacement)});
    r.n_dofs += 3 * std::size_t(grid.n_nodes());
  }
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
    const double* amplitudes = harmonic.surface.row(point).data();
    for (const auto& [channel, twin] : harmonic.parts) {
      const double even = twin ? sin_m : cos_m;
      const double odd = harmonic.m == 0 ? 1 : twin ? -cos_m : sin_m;
      const std::size_t at = node * n_channels + channel;
      add_at_angle(amplitudes, even, odd, cos, sin, &r.displacement_m[3 * at], &r.stress_Pa[6 * at]);
      amplitudes += 9;
    }
  }
}

}  // namespace

UnitResponses axisymmetric_responses(const MeridianBody& body, const std::vector<UnitLoad>& loads) {
  if (loads.empty()) throw std::invalid_argument("no unit loads: nothing to solve");
  if (body.n_angles < 4 || body.n_angles % 2 != 0)
    throw std::invalid_argument(std::to_string(body.n_angles) + " angles: must be even, 4 or more");
  const MeridianGrid grid = meridian_grid(body);
  UnitResponses r;
  r.solver.reason = "axisymmetric harmonics";
  const auto harmonics = solve_harmonics(grid, body, loads, r);
  r.nodes = revolved_nodes(grid, body.n_angles);
  r.displacement_m.assign(r.nodes.n * loads.size() * 3, 0);
  r.stress_Pa.assign(r.nodes.n * loads.size() * 6, 0);
  for (std::size_t node = 0; node < r.nodes.n; ++node) {
    const auto n_angles = std::size_t(body.n_angles);
    add_at_node(harmonics, Eigen::Index(node / n_angles), 2 * pi * double(node % n_angles) / body.n_angles,
                node, r);
  }
  return r;
}

}  // namespace fem
