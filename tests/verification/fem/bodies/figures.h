/// One load case of a clamped or free body, its figures beside their references, and the table of them all.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fem/models/solid/model.h"

namespace verification {

inline constexpr double pi = 3.14159265358979323846;

/// A sum of unit loads; channels are numbered here.
using LoadCase = std::vector<std::pair<decltype(fem::UnitLoad::shape), double>>;

/// Displacement and stress of a load case at the nodes, one node per column.
struct Solution {
  Eigen::Matrix3Xd place_m, displacement_m;
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress_Pa;  ///< xx, yy, zz, xy, yz, xz
  std::size_t n_dofs = 0;
  double seconds = 0;  ///< of reading the mesh, solving and recovering stress
  fem::Nodes nodes;
  fem::SolverReport solver;
  fem::EnergyNorms energy;

  /// The node at a place, to 1e-6 of the body's size.
  /// @throws std::out_of_range if there is none
  Eigen::Index at(const Eigen::Vector3d& place_m) const;
};
Solution solve(const fem::Body& body, const LoadCase& loads, fem::Recovery recovery = fem::Recovery::patch,
               fem::Solver solver = fem::Solver::automatic);

/// The resultant of a face, as a shape of a load case. The face's moments are about `centre_m`.
fem::SurfaceResultant on_face(int boundary_id, const Eigen::Vector3d& centre_m,
                              fem::SurfaceResultant::Component component);

/// Uniform pressure of 1 Pa [per unit of the load case's factor] on a curved side, as it is: pushes into the
/// material. `centre_m` and `length_m` are those of the side along z.
fem::SeatPressure uniform_pressure(int boundary_id, const Eigen::Vector3d& centre_m, double length_m);

double von_Mises(const Eigen::Matrix<double, 6, 1>& stress);

struct Figure {
  std::string name;  ///< of the public case, P01 to P26
  std::string quantity;
  double reference = 0, ours = 0;
};

/// Expects ours within the relative tolerance of the reference, and adds a row to the table. Tolerances are
/// those that the public cases suggest: what a mesh that is fine enough leaves, and what the source rounded.
void check(const Figure& figure, const Solution& solution, double tolerance);

/// Expects an observed order of convergence in [expected - slack, expected + excess]; adds a row.
void check_order(const Figure& figure, const Solution& finest, double slack, double excess);

/// Adds a row to the file that the environment variable MILLSTRESS_VERIFICATION_ROWS names; without it, does
/// nothing.
void add_row(const Figure& figure, bool is_order, std::size_t n_dofs, double seconds);

}  // namespace verification
