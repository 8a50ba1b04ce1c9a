#include "fem/axisymmetric_responses.h"

#include <cmath>
#include <map>
#include <stdexcept>

#include "fem/harmonic_loads.h"
#include "fem/harmonic_solver.h"
#include "fem/harmonic_strain.h"

namespace fem {
namespace {

constexpr double pi = 3.14159265358979323846;

/// What one harmonic adds to one channel.
struct Part {
  std::size_t channel;
  int m;
  bool twin;
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

std::vector<Part> solve_harmonics(const MeridianGrid& grid, const MeridianBody& body,
                                  const std::vector<UnitLoad>& loads, UnitResponses& r) {
  const HarmonicLoads load_of(grid, body);
  struct Column {
    std::size_t channel;
    bool twin;
    Eigen::VectorXd force;
  };
  std::map<int, std::vector<Column>> by_harmonic;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    auto forces = load_of(loads[k]);
    r.channels.push_back(loads[k].channel);
    r.resultants.push_back(load_of.resultant(forces));
    for (auto& part : forces) {
      const double applied = part.force.norm();
      load_of.balance(part.m, part.force);
      // A uniform acceleration is what balances a load: nothing but rounding is left of it.
      if (part.force.norm() > 1e-12 * applied)
        by_harmonic[part.m].push_back({k, part.twin, std::move(part.force)});
    }
  }
  const HarmonicSolver solver(grid, body.material);
  std::vector<Part> parts;
  for (const auto& [m, columns] : by_harmonic) {
    Eigen::MatrixXd force(3 * grid.n_nodes(), columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) force.col(Eigen::Index(k)) = columns[k].force;
    const Eigen::MatrixXd displacement = solver.solve(m, force, r.residual);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      Eigen::VectorXd u = displacement.col(Eigen::Index(k));
      load_of.remove_motion(m, u);
      parts.push_back(
          {columns[k].channel, m, columns[k].twin, surface_amplitudes(grid, body.material, m, u)});
    }
    r.n_dofs += 3 * std::size_t(grid.n_nodes());
  }
  return parts;
}

/// Adds a harmonic's part on one half plane.
void add_on_half_plane(const Part& part, double angle, std::size_t node_step, std::size_t first_node,
                       UnitResponses& r) {
  const std::size_t n_channels = r.channels.size();
  const double cos = std::cos(angle), sin = std::sin(angle);
  double even = 1, odd = 1;  // factors of the cosine's and the sine's amplitudes
  if (part.m > 0) {
    even = part.twin ? std::sin(part.m * angle) : std::cos(part.m * angle);
    odd = part.twin ? -std::cos(part.m * angle) : std::sin(part.m * angle);
  }
  for (Eigen::Index p = 0; p < part.surface.rows(); ++p) {
    const std::size_t at = (first_node + std::size_t(p) * node_step) * n_channels + part.channel;
    const auto a = part.surface.row(p);
    const double ur = even * a[0], ut = odd * a[1];
    double* u = &r.displacement_m[3 * at];
    u[0] += ur * cos - ut * sin;
    u[1] += ur * sin + ut * cos;
    u[2] += even * a[2];
    const double rr = even * a[3], tt = even * a[4], rz = even * a[6], rt = odd * a[7], tz = odd * a[8];
    double* s = &r.stress_Pa[6 * at];
    s[0] += rr * cos * cos + tt * sin * sin - 2 * rt * cos * sin;
    s[1] += rr * sin * sin + tt * cos * cos + 2 * rt * cos * sin;
    s[2] += even * a[5];
    s[3] += (rr - tt) * cos * sin + rt * (cos * cos - sin * sin);
    s[4] += rz * sin + tz * cos;
    s[5] += rz * cos - tz * sin;
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
  const auto parts = solve_harmonics(grid, body, loads, r);
  r.nodes = revolved_nodes(grid, body.n_angles);
  r.displacement_m.assign(r.nodes.n * loads.size() * 3, 0);
  r.stress_Pa.assign(r.nodes.n * loads.size() * 6, 0);
  for (int j = 0; j < body.n_angles; ++j)
    for (const auto& part : parts)
      add_on_half_plane(part, 2 * pi * j / body.n_angles, std::size_t(body.n_angles), std::size_t(j), r);
  return r;
}

}  // namespace fem
