#include "fem/solve/solvers/petsc_solver.h"

#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "fem/base/common/deadline.h"
#include "fem/base/common/parallel.h"
#include "fem/base/values/errors.h"
#include "fem/equations/loads/supports.h"
#include "fem/equations/matrices/petsc_session.h"
#include "fem/equations/operators/stiffness_rows.h"
#include "fem/mesh/grid/linear_level.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/ranks/ranks.h"

namespace fem {

namespace {

constexpr auto prefix = "fem_", failure = "the unit responses were not found";

/// Chebyshev of degree 4 takes a third fewer steps than of degree 2, for the same seconds.
constexpr auto two_levels =
    "-fem_ksp_type cg -fem_pc_type mg "
    "-fem_mg_levels_ksp_type chebyshev -fem_mg_levels_ksp_max_it 4 "
    "-fem_mg_levels_pc_type bjacobi -fem_mg_levels_sub_pc_type icc -fem_mg_coarse_ksp_type preonly ";
constexpr auto on_one_rank = "-fem_mg_coarse_pc_type cholesky -fem_mg_coarse_pc_factor_mat_solver_type mumps";
/// MUMPS on several ranks adds up in another order in each run: there the first rank has the coarse factor.
/// Incomplete factors of the ranks know nothing of each other, which a smoother of degree 5 makes up for.
constexpr auto on_several_ranks =
    "-fem_mg_levels_ksp_max_it 5 "
    "-fem_mg_coarse_pc_type telescope -fem_mg_coarse_telescope_ksp_type preonly "
    "-fem_mg_coarse_telescope_pc_type cholesky -fem_mg_coarse_telescope_pc_factor_mat_solver_type mumps "
    "-fem_mg_coarse_pc_telescope_reduction_factor ";

/// To which what an iteration leaves is solved for. It is alike all over the body, where rounding of a factor
/// goes with the stress: what is told has to hold where a twentieth of the largest stress is, too.
constexpr double share_of_rest = 0.1, least_stressed = 1.0 / 20;

/// By which the diagonal of a free body's trilinear level grows, so that it has a factor.
constexpr double share_of_mass = 1e-9;

PetscInt size(Eigen::Index n) {
  return static_cast<PetscInt>(n);
}

/// A matrix of compressed rows. PETSc refers to the rows on one rank and copies them on several.
void make_matrix(const PetscSession& petsc, MPI_Comm communicator, PetscInt n_columns, CompressedRows& rows,
                 PetscMatrix& matrix) {
  const auto n_rows = size(Eigen::Index(rows.begin.size()) - 1);
  if (n_ranks(communicator) == 1) {
    petsc.check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n_rows, n_columns, rows.begin.data(),
                                          rows.column.data(), rows.value.data(), &matrix.object));
  } else {
    petsc.check(MatCreateMPIAIJWithArrays(communicator, n_rows, n_columns, PETSC_DETERMINE, PETSC_DETERMINE,
                                          rows.begin.data(), rows.column.data(), rows.value.data(),
                                          &matrix.object));
    rows = {};
  }
  petsc.check(MatSetBlockSizes(matrix.object, 3, 3));
}

double entries(const PetscSession& petsc, Mat matrix) {
  MatInfo info{};
  petsc.check(MatGetInfo(matrix, MAT_LOCAL, &info));
  return info.nz_used;
}

/// Of the lower level's factor on this rank; none where the user has options of another kind.
double bytes_of_lower_factor(const PetscSession& petsc, KSP lower) {
  PC solver = nullptr;
  PetscBool is_telescope = PETSC_FALSE, is_factor = PETSC_FALSE;
  petsc.check(KSPGetPC(lower, &solver));
  petsc.check(PetscObjectTypeCompare(PetscObject(solver), PCTELESCOPE, &is_telescope));
  if (is_telescope) petsc.check(PCTelescopeGetKSP(solver, &lower));
  if (lower == nullptr) return 0;
  petsc.check(KSPGetPC(lower, &solver));
  petsc.check(PetscObjectTypeCompare(PetscObject(solver), PCCHOLESKY, &is_factor));
  Mat factor = nullptr;
  if (is_factor) petsc.check(PCFactorGetMatrix(solver, &factor));
  return is_factor ? 8 * entries(petsc, factor) : 0;
}

/// One column of a matrix as PETSc sees it.
class Column {
public:
  Column(const PetscSession& petsc, MPI_Comm communicator, const double* values, Eigen::Index n) {
    const auto make =
        n_ranks(communicator) == 1
            ? VecCreateSeqWithArray(PETSC_COMM_SELF, 3, size(n), values, &vector_.object)
            : VecCreateMPIWithArray(communicator, 3, size(n), PETSC_DETERMINE, values, &vector_.object);
    petsc.check(make);
  }
  operator Vec() const { return vector_.object; }  // NOLINT(google-explicit-constructor)

private:
  PetscVector vector_;
};

/// Over all ranks, of each column.
Eigen::RowVectorXd norms(MPI_Comm communicator, const Eigen::MatrixXd& columns) {
  Eigen::RowVectorXd squares = columns.colwise().squaredNorm();
  sum_over_ranks(communicator, squares.data(), std::size_t(squares.size()));
  return squares.cwiseSqrt();
}

/// Scalar products, column by column.
Eigen::RowVectorXd products(MPI_Comm communicator, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::RowVectorXd sums = a.cwiseProduct(b).colwise().sum();
  sum_over_ranks(communicator, sums.data(), std::size_t(sums.size()));
  return sums;
}

Eigen::RowVectorXd largest_entries(MPI_Comm communicator, const Eigen::MatrixXd& columns) {
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(columns.cols());
  if (columns.rows() > 0) largest = columns.colwise().lpNorm<Eigen::Infinity>();
  if (n_ranks(communicator) > 1)
    MPI_Allreduce(MPI_IN_PLACE, largest.data(), int(largest.size()), MPI_DOUBLE, MPI_MAX, communicator);
  return largest;
}

/// Ends an iteration on all ranks once the time is up on one of them.
/// @param is_up  a bool
PetscErrorCode stop_in_time(KSP iteration, PetscInt, PetscReal, void* is_up) {
  double n_late = seconds_to_deadline() <= 0 ? 1 : 0;
  sum_over_ranks(PetscObjectComm(reinterpret_cast<PetscObject>(iteration)), &n_late, 1);
  *static_cast<bool*>(is_up) = n_late > 0;
  return n_late > 0 ? PETSC_ERR_USER : 0;
}

/// The rows of interpolation from the linear level, and how many vertices this rank has.
CompressedRows interpolation_rows(const LinearLevel& level, const RowPlan& plan,
                                  const std::vector<std::int64_t>& clamped, PetscInt& n_own_vertices) {
  std::vector<std::int32_t> vertex_of_row;  // rows that are vertices, ascending
  for (std::size_t i = 0; i < plan.row.size(); ++i)
    if (plan.row[i] >= 0 && level.is_vertex(std::int32_t(i))) vertex_of_row.push_back(plan.row[i]);
  std::sort(vertex_of_row.begin(), vertex_of_row.end());
  n_own_vertices = size(
      std::count_if(vertex_of_row.begin(), vertex_of_row.end(), [&](auto row) { return plan.is_own(row); }));
  CompressedRows rows;
  std::vector<std::pair<std::int32_t, double>> weights;
  for (const auto node : plan.own) {
    weights.clear();
    for (auto k = level.begin[std::size_t(node)]; k < level.begin[std::size_t(node) + 1]; ++k) {
      const auto row = plan.row[std::size_t(level.vertex[k])];
      const auto at = std::lower_bound(vertex_of_row.begin(), vertex_of_row.end(), row);
      weights.emplace_back(std::int32_t(at - vertex_of_row.begin()), level.weight[k]);
    }
    std::sort(weights.begin(), weights.end());
    for (int d = 0; d < 3; ++d) {
      const bool is_held = std::binary_search(clamped.begin(), clamped.end(), 3 * std::int64_t(node) + d);
      for (const auto& [vertex, weight] : weights) {
        rows.column.push_back(3 * vertex + d);
        rows.value.push_back(is_held ? 0 : weight);
      }
      rows.begin.push_back(std::int32_t(rows.column.size()));
    }
  }
  return rows;
}

}  // namespace

struct PetscSolver::Impl {
  Impl(const BodyOnRanks& of, std::vector<int> rank_of_node, const std::vector<std::int64_t>& held,
       const SolverChoice& with)
      : body(of),
        clamped(held),
        choice(with),
        plan(of.grid, std::move(rank_of_node), this_rank(of.communicator), n_ranks(of.communicator)) {}

  const BodyOnRanks body;
  const std::vector<std::int64_t> clamped;
  const SolverChoice choice;
  const RowPlan plan;
  std::vector<std::int64_t> supports{};  ///< of a free body's factor
  CompressedRows rows{}, interpolation_{};
  PetscMatrix stiffness{}, interpolation{}, coarse{}, factor{};
  PetscHandle<MatNullSpace, MatNullSpaceDestroy> rigid{};
  PetscHandle<KSP, KSPDestroy> iteration{};
  double bytes = 0;         ///< of this rank
  double factor_bytes = 0;  ///< of this rank's part of a factor
  bool is_time_up = false;  ///< the iteration stopped for it

  bool is_direct() const { return choice.solver == Solver::direct; }
  MPI_Comm communicator() const { return body.communicator; }
  Eigen::Index n_rows() const { return 3 * Eigen::Index(plan.own.size()); }
  std::string options() const {
    const int n = n_ranks(communicator());
    return two_levels + (n == 1 ? on_one_rank : on_several_ranks + std::to_string(n)) +
           petsc_options_of_user(prefix);
  }

  void assemble(const PetscSession& petsc);
  void tell_rigid_motions(const PetscSession& petsc);
  void factorise(const PetscSession& petsc);
  void make_levels(const PetscSession& petsc);

  /// Places among this rank's rows of those of some unknowns that it has.
  std::vector<Eigen::Index> own_rows(const std::vector<std::int64_t>& unknowns) const {
    std::vector<Eigen::Index> result;
    for (const auto unknown : unknowns)
      if (const auto row = plan.row[std::size_t(unknown / 3)]; row >= 0 && plan.is_own(row))
        result.push_back(3 * Eigen::Index(row - plan.first) + unknown % 3);
    return result;
  }

  Eigen::MatrixXd multiply(const PetscSession& petsc, const Eigen::MatrixXd& u) const {
    Eigen::MatrixXd image(u.rows(), u.cols());
    for (Eigen::Index k = 0; k < u.cols(); ++k)
      petsc.check(MatMult(stiffness.object, Column(petsc, communicator(), u.col(k).data(), u.rows()),
                          Column(petsc, communicator(), image.col(k).data(), u.rows())));
    return image;
  }

  Eigen::MatrixXd solve_by_factor(const PetscSession& petsc, const Eigen::MatrixXd& force) const;
  Eigen::MatrixXd iterate(const PetscSession& petsc, const Eigen::MatrixXd& force,
                          const Eigen::RowVectorXd& residuals, const StepReport& progress, int& n_iterations,
                          std::string& ending) const;
};

void PetscSolver::Impl::assemble(const PetscSession& petsc) {
  agree(communicator(), [&] { rows = stiffness_rows(body.grid, body.cells, body.elastic, plan, clamped); });
  make_matrix(petsc, communicator(), size(n_rows()), rows, stiffness);
  petsc.check(MatSetOption(stiffness.object, MAT_SPD, PETSC_TRUE));
  bytes += 12 * entries(petsc, stiffness.object);
}

void PetscSolver::Impl::tell_rigid_motions(const PetscSession& petsc) {
  std::vector<double> xyz;
  for (const auto node : plan.own)
    xyz.insert(xyz.end(), body.grid.position(node), body.grid.position(node) + 3);
  petsc.check(
      MatNullSpaceCreateRigidBody(Column(petsc, communicator(), xyz.data(), n_rows()), &rigid.object));
  petsc.check(MatSetNearNullSpace(stiffness.object, rigid.object));
  if (clamped.empty()) petsc.check(MatSetNullSpace(stiffness.object, rigid.object));
}

/// By METIS on the matrix. MUMPS asks for more work space where its estimate was too small.
void PetscSolver::Impl::factorise(const PetscSession& petsc) {
  PetscMatrix held;
  Mat matrix = stiffness.object;
  if (clamped.empty()) {
    for (const auto unknown : choose_supports(body.grid)) supports.push_back(unknown);
    petsc.check(MatDuplicate(matrix, MAT_COPY_VALUES, &held.object));
    petsc.check(MatSetOption(held.object, MAT_SPD, PETSC_TRUE));
    std::vector<PetscInt> zeroed;
    for (const auto row : own_rows(supports)) zeroed.push_back(size(3 * Eigen::Index(plan.first) + row));
    PetscReal largest = 0;
    petsc.check(MatNorm(matrix, NORM_INFINITY, &largest));
    petsc.check(MatZeroRowsColumns(held.object, size(Eigen::Index(zeroed.size())), zeroed.data(), largest,
                                   nullptr, nullptr));
    matrix = held.object;
  }
  petsc.check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor.object));
  constexpr PetscInt ordering = 7, metis = 5, more_space = 14, most_attempts = 4;
  petsc.check(MatMumpsSetIcntl(factor.object, ordering, metis));
  petsc.check(MatSetOptionsPrefix(factor.object, prefix));
  MatFactorInfo info{};
  petsc.check(MatFactorInfoInitialize(&info));
  petsc.check(MatCholeskyFactorSymbolic(factor.object, matrix, nullptr, &info));
  PetscInt megabytes = 0;  // that MUMPS expects of this rank
  petsc.check(MatMumpsGetInfo(factor.object, 15, &megabytes));
  double missing = std::max(0.0, 1e6 * megabytes - free_memory_of_rank(communicator()));
  sum_over_ranks(communicator(), &missing, 1);
  if (missing > 0)
    throw DoesNotFit("the factor of " + std::to_string(body.grid.n_unknowns()) +
                     " unknowns does not fit into the memory of the ranks' machines, " +
                     std::to_string(std::lround(1e-6 * missing)) +
                     " MB are missing: use larger cells or more machines");
  PetscInt percent = 40, status = 0;
  for (PetscInt attempt = 0; attempt < most_attempts; ++attempt, percent *= 2) {
    petsc.check(MatMumpsSetIcntl(factor.object, more_space, percent));
    petsc.check(MatCholeskyFactorNumeric(factor.object, matrix, &info));
    petsc.check(MatMumpsGetInfog(factor.object, 1, &status));
    if (status >= 0) break;
    petsc.check(MatFactorClearError(factor.object));
    if (status != -8 && status != -9 && status != -20) break;
  }
  if (status == -10 || status == -40)
    throw FailedTogether(
        "the stiffness is not positive definite: the mesh may fall into parts that do not touch, or has "
        "degenerate cells");
  if (status < 0)
    throw FailedTogether("MUMPS could not factorise the stiffness (INFOG " + std::to_string(status) +
                         "): if memory does not suffice, use a coarser mesh, or ranks on more machines");
  PetscInt n_entries = 0;
  petsc.check(MatMumpsGetInfo(factor.object, 9, &n_entries));
  factor_bytes = 8 * (n_entries < 0 ? -1e6 * double(n_entries) : double(n_entries));
  bytes += factor_bytes;
}

void PetscSolver::Impl::make_levels(const PetscSession& petsc) {
  PetscInt n_own_vertices = 0;
  interpolation_ = interpolation_rows(make_linear_level(body.grid), plan, clamped, n_own_vertices);
  make_matrix(petsc, communicator(), 3 * n_own_vertices, interpolation_, interpolation);
  petsc.check(
      MatPtAP(stiffness.object, interpolation.object, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &coarse.object));
  petsc.check(MatSetBlockSize(coarse.object, 3));
  petsc.check(MatSetOption(coarse.object, MAT_SPD, PETSC_TRUE));
  PetscVector diagonal;
  petsc.check(MatCreateVecs(coarse.object, &diagonal.object, nullptr));
  petsc.check(MatGetDiagonal(coarse.object, diagonal.object));
  PetscReal largest = 0;
  petsc.check(VecNorm(diagonal.object, NORM_INFINITY, &largest));
  PetscScalar* entry = nullptr;
  PetscInt n = 0;
  petsc.check(VecGetLocalSize(diagonal.object, &n));
  petsc.check(VecGetArray(diagonal.object, &entry));
  for (PetscInt i = 0; i < n; ++i)  // a vertex that clamps hold has none
    entry[i] = entry[i] > 0 ? (clamped.empty() ? share_of_mass * entry[i] : 0) : largest;
  petsc.check(VecRestoreArray(diagonal.object, &entry));
  petsc.check(MatDiagonalSet(coarse.object, diagonal.object, ADD_VALUES));

  auto* const ksp = &iteration.object;
  PC levels = nullptr;
  petsc.check(KSPCreate(n_ranks(communicator()) == 1 ? PETSC_COMM_SELF : communicator(), ksp));
  petsc.check(KSPSetOptionsPrefix(*ksp, prefix));
  petsc.check(KSPSetOperators(*ksp, stiffness.object, stiffness.object));
  petsc.check(KSPSetType(*ksp, KSPCG));
  petsc.check(KSPSetNormType(*ksp, KSP_NORM_UNPRECONDITIONED));
  petsc.check(KSPGetPC(*ksp, &levels));
  petsc.check(PCSetType(levels, PCMG));
  petsc.check(PCMGSetLevels(levels, 2, nullptr));
  petsc.check(PCMGSetInterpolation(levels, 1, interpolation.object));
  KSP lower = nullptr, smoother = nullptr;
  petsc.check(PCMGGetCoarseSolve(levels, &lower));
  petsc.check(KSPSetOperators(lower, coarse.object, coarse.object));
  petsc.check(PCMGGetSmoother(levels, 1, &smoother));
  petsc.check(KSPSetOperators(smoother, stiffness.object, stiffness.object));
  petsc.check(KSPSetFromOptions(*ksp));
  petsc.check(KSPMonitorSet(*ksp, stop_in_time, &is_time_up, nullptr));
  petsc.check(KSPSetUp(*ksp));
  constexpr double incomplete_factor = 6;  // bytes for each entry of K: one triangle
  bytes += incomplete_factor * entries(petsc, stiffness.object) + bytes_of_lower_factor(petsc, lower) +
           12 * (entries(petsc, interpolation.object) + entries(petsc, coarse.object));
}

PetscSolver::PetscSolver(const BodyOnRanks& body, std::vector<int> rank_of_node,
                         const std::vector<std::int64_t>& clamped, const SolverChoice& choice)
    : impl_(std::make_unique<Impl>(body, std::move(rank_of_node), clamped, choice)) {
  const SerialBlas serial;
  const PetscSession petsc(failure, impl_->options());
  impl_->assemble(petsc);
  impl_->tell_rigid_motions(petsc);
  if (impl_->is_direct())
    impl_->factorise(petsc);
  else
    impl_->make_levels(petsc);
}

PetscSolver::~PetscSolver() = default;

const std::vector<std::int32_t>& PetscSolver::nodes() const {
  return impl_->plan.own;
}

Eigen::MatrixXd PetscSolver::Impl::solve_by_factor(const PetscSession& petsc,
                                                   const Eigen::MatrixXd& force) const {
  Eigen::MatrixXd in = force, u(force.rows(), force.cols());
  const auto dense = [&](Eigen::MatrixXd& block, PetscMatrix& matrix) {
    petsc.check(MatCreateDense(communicator(), size(n_rows()), PETSC_DECIDE, PETSC_DETERMINE,
                               size(block.cols()), block.data(), &matrix.object));
  };
  PetscMatrix forces, displacements;
  dense(in, forces);
  dense(u, displacements);
  petsc.check(MatMatSolve(factor.object, forces.object, displacements.object));
  return u;
}

Eigen::MatrixXd PetscSolver::Impl::iterate(const PetscSession& petsc, const Eigen::MatrixXd& force,
                                           const Eigen::RowVectorXd& residuals, const StepReport& progress,
                                           int& n_iterations, std::string& ending) const {
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(force.rows(), force.cols());
  constexpr double any = 1e30;
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    progress(0.2 + 0.65 * double(k) / double(u.cols()), "iterate");
    petsc.check(KSPSetTolerances(iteration.object, 1 / any, residuals[k], any, choice.max_iterations));
    const auto code = KSPSolve(iteration.object, Column(petsc, communicator(), force.col(k).data(), u.rows()),
                               Column(petsc, communicator(), u.col(k).data(), u.rows()));
    if (is_time_up) throw OutOfTime("the time is up");
    petsc.check(code);
    KSPConvergedReason reason{};
    PetscInt steps = 0;
    petsc.check(KSPGetConvergedReason(iteration.object, &reason));
    petsc.check(KSPGetIterationNumber(iteration.object, &steps));
    n_iterations = std::max(n_iterations, int(steps));
    if (reason > 0 || !ending.empty()) continue;
    std::ostringstream text;
    text << "the iteration " << (reason == KSP_DIVERGED_ITS ? "did not converge" : "broke down") << " after "
         << steps << " steps (" << KSPConvergedReasons[reason] << ")";
    ending = text.str();
  }
  return u;
}

Solution PetscSolver::solve_rows(const BalancedLoads& loads, const StepReport& progress) const {
  const auto& impl = *impl_;
  const SerialBlas serial;
  const PetscSession petsc(failure, impl.options());
  const auto communicator = impl.communicator();
  BalancedLoads free = loads;
  for (const auto row : impl.own_rows(impl.clamped)) free.force.row(row).setZero();
  const auto held = impl.own_rows(impl.supports);
  Eigen::MatrixXd supported_force(Eigen::Index(held.size()), loads.force.cols());
  for (std::size_t i = 0; i < held.size(); ++i) {
    supported_force.row(Eigen::Index(i)) = free.force.row(held[i]);
    free.force.row(held[i]).setZero();
  }
  Solution solution;
  std::string ending;  // of an iteration that stops before its tolerance: rounding may be in its way
  Eigen::MatrixXd& u = solution.displacement;
  if (impl.is_direct()) progress(0.75, "solve");
  u = impl.is_direct() ? impl.solve_by_factor(petsc, free.force)
                       : impl.iterate(petsc, free.force, impl.choice.relative_tolerance * loads.norm,
                                      progress, solution.n_iterations, ending);
  Eigen::MatrixXd rest;
  const auto take_residual = [&] {
    rest = free.force - impl.multiply(petsc, u);
    Eigen::MatrixXd reaction(Eigen::Index(held.size()), rest.cols());
    for (std::size_t i = 0; i < held.size(); ++i) {
      reaction.row(Eigen::Index(i)) = rest.row(held[i]) + supported_force.row(Eigen::Index(i));
      rest.row(held[i]).setZero();
    }
    solution.support_reaction =
        largest_entries(communicator, reaction).cwiseQuotient(loads.largest_entry).maxCoeff();
    solution.residual = norms(communicator, rest).cwiseQuotient(loads.norm).maxCoeff();
  };
  take_residual();
  const auto correct = [&](const Eigen::MatrixXd& correction, double least_residual) {
    const Eigen::RowVectorXd sizes = largest_entries(communicator, u), rest_norm = norms(communicator, rest),
                             changes = largest_entries(communicator, correction),
                             work = products(communicator, u, free.force),
                             missing_work = products(communicator, correction, rest);
    for (Eigen::Index k = 0; k < u.cols(); ++k)
      if (rest_norm[k] > least_residual * loads.norm[k] && sizes[k] > 0 && work[k] > 0)  // else no strain
        solution.rounding = std::max(
            {solution.rounding, changes[k] / sizes[k], std::sqrt(std::max(0.0, missing_work[k]) / work[k])});
    agree(communicator, [&] { refuse_rounding(impl.body.grid, solution.rounding); });
    u += correction;
    take_residual();
    if (!impl.is_direct()) solution.rounding /= least_stressed;
  };
  if (impl.is_direct() && solution.residual > acceptable_residual)
    correct(impl.solve_by_factor(petsc, rest), acceptable_residual);
  // Bodies that bend easily turn a small residual into a large displacement: what is left is solved for, too.
  // Its share in the energy is that of its strain.
  if (!impl.is_direct() && solution.residual <= acceptable_residual) {
    int n_steps = 0;
    std::string stopped;  // by rounding, which the next residual tells
    correct(impl.iterate(petsc, rest, share_of_rest * norms(communicator, rest), progress, n_steps, stopped),
            0);
  }
  if (!impl.is_direct() && !(solution.residual <= acceptable_residual)) {
    std::ostringstream message;
    message << (ending.empty() ? "the iteration converged" : ending) << " and leaves a share of "
            << solution.residual
            << " of the loads; solve with solver = \"direct\", or use cells of a more equal shape";
    throw FailedTogether(message.str());
  }
  solution.bytes = impl.bytes;
  solution.factor_gigabytes = 1e-9 * impl.factor_bytes;
  sum_over_ranks(communicator, &solution.factor_gigabytes, 1);
  return solution;
}

Solution PetscSolver::solve_whole(const BalancedLoads& loads, const StepReport& progress) const {
  const auto& own = nodes();
  BalancedLoads of_rows;
  of_rows.norm = loads.norm;
  of_rows.largest_entry = loads.largest_entry;
  of_rows.force.resize(impl_->n_rows(), loads.force.cols());
  for (std::size_t i = 0; i < own.size(); ++i)
    of_rows.force.middleRows<3>(3 * Eigen::Index(i)) = loads.force.middleRows<3>(3 * Eigen::Index(own[i]));
  Solution solution = solve_rows(of_rows, progress);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(loads.force.rows(), loads.force.cols());
  for (std::size_t i = 0; i < own.size(); ++i)
    whole.middleRows<3>(3 * Eigen::Index(own[i])) = solution.displacement.middleRows<3>(3 * Eigen::Index(i));
  complete(impl_->communicator(), whole.data(), std::size_t(whole.size()));
  solution.displacement = std::move(whole);
  return solution;
}

Eigen::MatrixXd PetscSolver::solve(const Eigen::MatrixXd& force) const {
  BalancedLoads loads;
  loads.force = force;
  loads.norm = force.colwise().norm().cwiseMax(1e-300);
  loads.largest_entry = force.colwise().lpNorm<Eigen::Infinity>().cwiseMax(1e-300);
  return solve_whole(loads, [](double, const std::string&) {}).displacement;
}

}  // namespace fem
