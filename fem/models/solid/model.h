/// The finite-element model of one body: mesh, degrees of freedom, stiffness; solves all unit loads as one
/// block.
#pragma once

#include <mpi.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/geometry_error.h"
#include "fem/base/values/natural_mode.h"
#include "fem/base/values/solver_choice.h"
#include "fem/base/values/stress_goal.h"
#include "fem/base/values/unit_load.h"
#include "fem/base/values/unit_responses.h"

namespace fem {

/// Starts MPI, which takes up to half a second, and the threads of deal.II; one object lives as long as the
/// program uses fem. Further ones while it lives set the number of threads.
class Environment {
public:
  /// @param n_threads of each rank; 0: all cores, shared among the ranks of a machine
  explicit Environment(int n_threads);
  ~Environment();
  Environment(const Environment&) = delete;
  /// Threads of this rank.
  static int n_threads();
  /// MPI is not ended in this process, whose end does that: for a library that its end would crash.
  static void leave_mpi();
  Environment& operator=(const Environment&) = delete;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Told the share done, 0 to 1, and the name of the step that starts.
using Progress = std::function<void(double, const std::string&)>;

/// How nodal stresses are made from the finite-element stress.
enum class Recovery {
  patch,    ///< superconvergent patch recovery (Zienkiewicz and Zhu 1992); surfaces that no load of the call
            ///< acts on also give their strains along the surface, with no traction across it
  average,  ///< mean of the cells' values at each node: a baseline for tests
};

class Model {
public:
  /// Reads the mesh, attaches the charts, numbers the unknowns.
  /// @param communicator  whose ranks share the work: every one makes the model of the same body, and calls
  /// what solves together with the others
  /// @param progress told that reading starts; may be empty
  /// @throws MeshUnusable if the mesh cannot be read, has inverted cells or several pieces
  /// @throws std::invalid_argument for impossible material values
  explicit Model(const Body& body, MPI_Comm communicator = MPI_COMM_WORLD, const Progress& progress = {});
  ~Model();
  Model(Model&&) noexcept;

  std::size_t n_dofs() const;
  MassProperties mass_properties() const;
  /// Mass properties of the cells of some volume groups.
  /// @throws std::invalid_argument if one of the groups has no cells
  MassProperties mass_properties(const std::vector<int>& volume_ids) const;

  /// At the quadrature points of boundary faces; zero where no surface is known.
  /// @param seats  cylinders known from elsewhere (imported bodies have no charts)
  GeometryError geometry_error(const std::vector<LoadSurface>& seats = {}) const;

  /// The solver that unit_responses would take for so many unit loads, why, and what both are predicted to
  /// need (SolverReport::predicted): seconds of the machine in base/values/cost_constants.h, bytes. Solves
  /// nothing.
  /// @throws DoesNotFit if no solver would fit into this machine's memory
  SolverReport predict_solver(std::size_t n_loads, const SolverChoice& choice) const;

  /// The unit loads' responses: by one factorisation (CHOLMOD, of one half after the other or of one alone
  /// where the body is its own mirror image, solve/solvers/mirrored_halves.h, on rank 0 alone; of other
  /// bodies MUMPS on several ranks) on a statically determinate support, or by conjugate gradients on the
  /// free body. Every load vector is balanced by a rigid-mode body force, f - M R (R'MR)^-1 R'f, so the
  /// support carries nothing; displacements have no rigid part in the mass norm. The body's elastic supports
  /// act on these displacements, and their forces close among themselves. A body with clamps is held by them
  /// instead: loads act as they are, displacements are those in space.
  /// @param progress called with a share 0..1 and the name of the step that starts; may be empty
  /// @param choice of the solver; UnitResponses::solver tells which one was taken and why
  /// @throws std::invalid_argument for an empty list, a repeated channel, a surface without faces,
  /// clamps that leave a rigid motion, clamps together with elastic supports
  /// @throws SolveFailed if the factorisation fails, rounding reaches 1 % of displacements, or the iteration
  /// does not end; DoesNotFit if no solver fits into memory
  UnitResponses unit_responses(const std::vector<UnitLoad>& loads, const std::vector<SectionPlane>& planes,
                               Recovery recovery = Recovery::patch, const Progress& progress = {},
                               const SolverChoice& choice = {}) const;

  /// What each cell contributes to the errors of stresses at places, estimated
  /// (refine/adaptivity/goal_errors.h). One more solve for each goal; by the factor or levels of
  /// unit_responses where SolverChoice::keep_factor kept them.
  /// @param responses  of this model
  /// @return goal after goal, one value per cell [Pa]; their sum estimates the error of the goal
  /// @throws std::invalid_argument for tetrahedra, goals that do not fit the responses
  /// @throws SolveFailed as unit_responses
  std::vector<std::vector<double>> goal_errors_Pa(const UnitResponses& responses,
                                                  const std::vector<StressGoal>& goals) const;

  /// Gives away the factor that SolverChoice::keep_factor kept; goal_errors_Pa then makes another one.
  void release_factor() const;

  /// The lowest natural frequencies, ascending, without the rigid motions that nothing holds. Mass and
  /// stiffness are consistent, so frequencies come out from above. Clamps hold the body; elastic supports are
  /// springs to the ground against its whole motion, rigid part included (unlike in unit_responses, where
  /// inertia carries that part). Rank 0 works alone. Same bits for the same body and number of threads.
  /// @param n_modes  at least 1, at most a tenth of the unknowns that can vibrate: a mesh has no more to say
  /// @param attached  rigid masses that move with the mean motion of their surfaces; of these modes alone
  /// @throws std::invalid_argument for another number, for clamps that leave a rigid motion, clamps together
  /// with elastic supports, masses that are negative
  /// @throws SolveFailed if the factorisation fails, or a mode leaves more than 1e-4 of its inertia
  /// forces unbalanced and rounding does not explain it
  std::vector<NaturalMode> natural_frequencies(int n_modes,
                                               const std::vector<AttachedMass>& attached = {}) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fem
