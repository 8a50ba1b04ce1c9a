// Krylov-Schur: Stewart, SIAM J. Matrix Anal. Appl. 23 (2001) 601. SLEPc: Hernandez, Roman and Vidal, ACM
// Trans. Math. Softw. 31 (2005) 351.
//
// A Krylov space holds one direction of each eigenspace: that of the start's share in it (Parlett, The
// Symmetric Eigenvalue Problem, 1998, ch. 12). A search therefore finds one mode of a pair, and the other one
// only when rounding brings it. So the search is repeated from other starts in the complement of all modes
// that are known, until the lowest mode that it finds there lies above the highest wanted one. What that last
// search misses has no share in its start, which is pseudo-random: that happens with probability zero, and
// small shares grow.
#include "fem/solve/modes/krylov_schur.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "fem/base/values/errors.h"
#include "fem/equations/matrices/petsc_session.h"

namespace fem {

namespace {

// |K^-1 M x - x / w^2| in the mass norm, over 1 / w^2. Inertia forces are left unbalanced by some ten times
// that, 1e-4 of them at most are accepted (natural_frequencies.cc); squares of frequencies are off by its
// square.
constexpr double converged = 1e-10;
constexpr int most_restarts = 100;      // of one search; shafts and chambers take 2 to 10
constexpr unsigned most_searches = 50;  // shafts and chambers take 2 or 3

[[noreturn]] void fail(const std::string& what) {
  throw SolveFailed("the natural frequencies do not converge: " + what +
                    "; ask for fewer or check the mesh for degenerate cells");
}

/// The same numbers with every standard library.
Eigen::VectorXd pseudo_random(Eigen::Index n_rows, unsigned seed) {
  std::mt19937_64 engine(seed);
  Eigen::VectorXd x(n_rows);
  for (auto& entry : x) entry = static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5;
  return x;
}

using EigenSolver = PetscHandle<EPS, EPSDestroy>;

/// What SLEPc's callbacks know of a search.
struct Search {
  const VibrationProblem& problem;
  std::size_t n_modes;
  std::vector<double> known;  ///< 1 / w^2 that were found before or have converged in this search
  double smallest = std::numeric_limits<double>::infinity();  ///< of those that have converged in this search
  std::exception_ptr failure{};                               ///< what a product threw

  /// Largest values converge first: what this search could still find is smaller than what it has.
  bool is_done() const {
    return std::count_if(known.begin(), known.end(), [&](double t) { return t >= smallest; }) >=
           static_cast<std::ptrdiff_t>(n_modes);
  }
};

/// y = f(x). SLEPc is written in C: no exception may pass through it.
PetscErrorCode apply(Search& search, const BlockOperator& f, Vec x, Vec y) {
  const auto n = search.problem.n_rows;
  const double* in = nullptr;
  PetscCall(VecGetArrayRead(x, &in));
  const Eigen::MatrixXd argument = Eigen::Map<const Eigen::VectorXd>(in, n);
  PetscCall(VecRestoreArrayRead(x, &in));
  Eigen::MatrixXd result;
  try {
    result = f(argument);
  } catch (...) {
    search.failure = std::current_exception();
    return PETSC_ERR_USER;
  }
  double* out = nullptr;
  PetscCall(VecGetArrayWrite(y, &out));
  Eigen::Map<Eigen::VectorXd>(out, n) = result;
  return VecRestoreArrayWrite(y, &out);
}

PetscErrorCode apply_stiffness(Mat matrix, Vec x, Vec y) {
  Search* search = nullptr;
  PetscCall(MatShellGetContext(matrix, &search));
  return apply(*search, search->problem.stiffness, x, y);
}

PetscErrorCode apply_mass(Mat matrix, Vec x, Vec y) {
  Search* search = nullptr;
  PetscCall(MatShellGetContext(matrix, &search));
  return apply(*search, search->problem.mass, x, y);
}

PetscErrorCode apply_inverse(PC preconditioner, Vec x, Vec y) {
  Search* search = nullptr;
  PetscCall(PCShellGetContext(preconditioner, &search));
  return apply(*search, search->problem.inverse, x, y);
}

/// SLEPc asks for one value after the other, until one has not converged.
/// @param value  1 / w^2
PetscErrorCode test_convergence(EPS, PetscScalar value, PetscScalar, PetscReal residual, PetscReal* error,
                                void* context) {
  auto& search = *static_cast<Search*>(context);
  *error = residual / std::abs(value);
  if (*error < converged) {
    search.known.push_back(value);
    search.smallest = std::min(search.smallest, value);
  }
  return 0;
}

PetscErrorCode test_stop(EPS, PetscInt n_restarts, PetscInt most, PetscInt n_converged, PetscInt n_wanted,
                         EPSConvergedReason* reason, void* context) {
  if (n_converged >= n_wanted || static_cast<const Search*>(context)->is_done())
    *reason = EPS_CONVERGED_USER;
  else if (n_restarts >= most)
    *reason = EPS_DIVERGED_ITS;
  return 0;
}

/// Vectors of PETSc on the columns of matrices, which outlive them.
class Columns {
public:
  void add(const PetscSession& petsc, const Eigen::MatrixXd& x) {
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      auto& vector = handles_.emplace_back();
      petsc.check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(x.rows()), x.col(c).data(),
                                        &vector.object));
      vectors_.push_back(vector.object);
    }
  }
  PetscInt size() const { return static_cast<PetscInt>(vectors_.size()); }
  Vec* data() { return vectors_.data(); }

private:
  std::deque<PetscVector> handles_;
  std::vector<Vec> vectors_;
};

void make_shell(const PetscSession& petsc, Search& search, PetscErrorCode (*multiply)(Mat, Vec, Vec),
                PetscMatrix& matrix) {
  const auto n = static_cast<PetscInt>(search.problem.n_rows);
  petsc.check(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, &search, &matrix.object));
  petsc.check(MatShellSetOperation(matrix.object, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
}

/// (K - 0 M)^-1 by the problem's own inverse.
void shift_and_invert_about_zero(const PetscSession& petsc, Search& search, EPS solver) {
  ST transformation = nullptr;
  petsc.check(EPSGetST(solver, &transformation));
  petsc.check(STSetType(transformation, STSINVERT));
  petsc.check(STSetMatMode(transformation, ST_MATMODE_SHELL));
  petsc.check(EPSSetTarget(solver, 0));
  petsc.check(EPSSetWhichEigenpairs(solver, EPS_TARGET_MAGNITUDE));
  KSP linear_solver = nullptr;
  petsc.check(STGetKSP(transformation, &linear_solver));
  petsc.check(KSPSetType(linear_solver, KSPPREONLY));
  PC inverse = nullptr;
  petsc.check(KSPGetPC(linear_solver, &inverse));
  petsc.check(PCSetType(inverse, PCSHELL));
  petsc.check(PCShellSetContext(inverse, &search));
  petsc.check(PCShellSetApply(inverse, apply_inverse));
}

Eigenpairs converged_pairs(const PetscSession& petsc, EPS solver, Eigen::Index n_rows) {
  PetscInt n = 0;
  petsc.check(EPSGetConverged(solver, &n));
  Eigenpairs pairs{Eigen::VectorXd(n), Eigen::MatrixXd(n_rows, n)};
  Columns shapes;
  shapes.add(petsc, pairs.vector);
  for (PetscInt i = 0; i < n; ++i)
    petsc.check(EPSGetEigenpair(solver, i, &pairs.value[i], nullptr, shapes.data()[i], nullptr));
  return pairs;
}

/// Some of the lowest modes beside those left out and found, ascending.
/// @param n_most  that end the search; it ends before where all n_modes are known, found ones included
Eigenpairs search_beside(const PetscSession& petsc, const VibrationProblem& problem, const Eigenpairs& found,
                         int n_modes, int n_most, const Eigen::MatrixXd& start) {
  Search search{problem, std::size_t(n_modes), {}};
  for (const double square : found.value) search.known.push_back(1 / square);
  PetscMatrix stiffness, mass;
  make_shell(petsc, search, apply_stiffness, stiffness);
  make_shell(petsc, search, apply_mass, mass);
  Columns beside, begin;
  beside.add(petsc, problem.left_out);
  beside.add(petsc, found.vector);
  begin.add(petsc, start);

  EigenSolver solver;
  petsc.check(EPSCreate(PETSC_COMM_SELF, &solver.object));
  petsc.check(EPSSetOperators(solver.object, stiffness.object, mass.object));
  petsc.check(EPSSetProblemType(solver.object, EPS_GHEP));
  petsc.check(EPSSetType(solver.object, EPSKRYLOVSCHUR));
  shift_and_invert_about_zero(petsc, search, solver.object);
  petsc.check(EPSSetDimensions(solver.object, n_most, PETSC_DEFAULT, PETSC_DEFAULT));
  petsc.check(EPSSetTolerances(solver.object, converged, most_restarts));
  petsc.check(EPSSetConvergenceTestFunction(solver.object, test_convergence, &search, nullptr));
  petsc.check(EPSSetStoppingTestFunction(solver.object, test_stop, &search, nullptr));
  // Purifying takes a solve for each mode and changes nothing: all vectors come out of the inverse.
  petsc.check(EPSSetPurify(solver.object, PETSC_FALSE));
  if (beside.size() > 0) petsc.check(EPSSetDeflationSpace(solver.object, beside.size(), beside.data()));
  petsc.check(EPSSetInitialSpace(solver.object, begin.size(), begin.data()));

  const auto code = EPSSolve(solver.object);
  if (search.failure) std::rethrow_exception(search.failure);
  petsc.check(code);
  EPSConvergedReason reason{};
  petsc.check(EPSGetConvergedReason(solver.object, &reason));
  if (reason == EPS_DIVERGED_ITS)
    fail(std::to_string(most_restarts) + " restarts were not enough for " + std::to_string(n_modes));
  if (reason < 0) fail("SLEPc's reason is " + std::to_string(reason));
  return converged_pairs(petsc, solver.object, problem.n_rows);
}

/// The pairs of both, ascending.
Eigenpairs joined(const Eigenpairs& a, const Eigenpairs& b) {
  Eigenpairs both{Eigen::VectorXd(a.value.size() + b.value.size()),
                  Eigen::MatrixXd(a.vector.rows(), a.value.size() + b.value.size())};
  both.value << a.value, b.value;
  both.vector << a.vector, b.vector;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(both.value.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return both.value[i] < both.value[j]; });
  return {both.value(order), both.vector(Eigen::all, order)};
}

}  // namespace

Eigenpairs lowest_modes(const VibrationProblem& problem, int n_modes) {
  const PetscSession petsc("the natural frequencies do not converge");
  const auto n_rows = problem.n_rows;
  Eigenpairs found{Eigen::VectorXd(0), Eigen::MatrixXd(n_rows, 0)};
  for (unsigned i = 1; i <= most_searches; ++i) {
    const Eigen::MatrixXd start =
        i == 1 && problem.start.size() > 0 ? problem.start : pseudo_random(n_rows, i);
    const int n_most = i == 1 ? n_modes : n_modes / 4 + 1;  // the first search leaves little to the others
    const auto more = search_beside(petsc, problem, found, n_modes, n_most, start);
    const bool is_last =
        found.value.size() >= n_modes &&
        more.value[0] >= found.value[n_modes - 1] * (1 - converged);  // the same again, or higher
    if (is_last) return {found.value.head(n_modes), found.vector.leftCols(n_modes)};
    found = joined(found, more);
  }
  fail(std::to_string(most_searches) + " searches still found others of the lowest " +
       std::to_string(n_modes));
}

}  // namespace fem
