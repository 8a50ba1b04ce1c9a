#include "tests/verification/fem/bodies/figures.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace verification {

Eigen::Index Solution::at(const Eigen::Vector3d& place) const {
  Eigen::Index node = 0;
  const double distance = (place_m.colwise() - place).colwise().norm().minCoeff(&node);
  const double size = (place_m.colwise() - place).colwise().norm().maxCoeff();
  if (distance > 1e-6 * size) {
    std::ostringstream message;
    message << "no node at " << place.transpose() << ": the nearest is " << distance << " m away";
    throw std::out_of_range(message.str());
  }
  return node;
}

Solution solve(const fem::Body& body, const LoadCase& loads, fem::Recovery recovery, fem::Solver solver) {
  std::vector<fem::UnitLoad> unit_loads;
  for (const auto& [shape, factor] : loads)
    unit_loads.push_back({"load." + std::to_string(unit_loads.size()), shape});
  const auto start = std::chrono::steady_clock::now();
  const auto r = fem::Model(body).unit_responses(unit_loads, {}, recovery, {}, {solver, 1e-10, 100});
  Solution solution;
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  solution.n_dofs = r.n_dofs;
  solution.nodes = r.nodes;
  solution.solver = r.solver;
  std::vector<double> factors;
  for (const auto& load : loads) factors.push_back(load.second);
  solution.energy = fem::energy_norms(r.energy_error, factors);
  const auto n = static_cast<Eigen::Index>(r.nodes.n), n_loads = static_cast<Eigen::Index>(loads.size());
  solution.place_m = Eigen::Map<const Eigen::Matrix3Xd>(r.nodes.xyz_m.data(), 3, n);
  solution.displacement_m = Eigen::Matrix3Xd::Zero(3, n);
  solution.stress_Pa = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n_loads; ++k) {
      const double factor = loads[k].second;
      solution.displacement_m.col(i) +=
          factor * Eigen::Map<const Eigen::Vector3d>(&r.displacement_m[(i * n_loads + k) * 3]);
      solution.stress_Pa.col(i) +=
          factor * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(&r.stress_Pa[(i * n_loads + k) * 6]);
    }
  return solution;
}

fem::SurfaceResultant on_face(int boundary_id, const Eigen::Vector3d& centre_m,
                              fem::SurfaceResultant::Component component) {
  fem::LoadSurface face;
  face.kind = fem::LoadSurface::Kind::face;
  face.boundary_id = boundary_id;
  face.centre_m = {centre_m[0], centre_m[1], centre_m[2]};
  return {face, component};
}

fem::SeatPressure uniform_pressure(int boundary_id, const Eigen::Vector3d& centre_m, double length_m) {
  fem::SeatPressure load;
  load.surface.boundary_id = boundary_id;
  load.surface.centre_m = {centre_m[0], centre_m[1], centre_m[2]};
  load.surface.radius_m = 1;  // in the pattern's own scale only
  load.surface.length_m = length_m;
  load.coefficient = pi * load.surface.radius_m * length_m;
  load.keeps_resultants = true;
  return load;
}

double von_Mises(const Eigen::Matrix<double, 6, 1>& s) {
  return std::sqrt(
      ((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) + (s[2] - s[0]) * (s[2] - s[0])) / 2 +
      3 * s.tail<3>().squaredNorm());
}

void check(const Figure& figure, const Solution& solution, double tolerance) {
  EXPECT_NEAR(figure.ours / figure.reference, 1, tolerance)
      << figure.name << " " << figure.quantity << ": " << figure.ours << " for " << figure.reference << ", "
      << solution.n_dofs << " unknowns";
  add_row(figure, false, solution.n_dofs, solution.seconds);
}

void check_order(const Figure& figure, const Solution& finest, double slack, double excess) {
  EXPECT_GE(figure.ours, figure.reference - slack) << figure.name << " " << figure.quantity;
  EXPECT_LE(figure.ours, figure.reference + excess) << figure.name << " " << figure.quantity;
  add_row(figure, true, finest.n_dofs, finest.seconds);
}

void add_row(const Figure& figure, bool is_order, std::size_t n_dofs, double seconds) {
  const char* file = std::getenv("MILLSTRESS_VERIFICATION_ROWS");
  if (file == nullptr) return;
  std::ofstream out(file, std::ios::app);
  out.precision(7);
  out << figure.name << "\t" << figure.quantity << "\t" << figure.reference << "\t" << figure.ours << "\t";
  const double error = is_order ? figure.ours - figure.reference : figure.ours / figure.reference - 1;
  out.precision(2);
  if (is_order)
    out << std::showpos << std::fixed << error;
  else if (std::abs(error) < 5e-5)
    out << std::showpos << std::scientific << std::setprecision(0) << error;
  else
    out << std::showpos << std::fixed << 100 * error << " %";
  out.precision(2);
  out << std::noshowpos << std::fixed;
  out << "\t" << n_dofs << "\t" << seconds << "\n";
}

}  // namespace verification
