/// Global-coarsening multigrid with the lanes of one instruction set: a shared object of its own, as
/// wide_matrix_free.cc. Levels from the finest: degree 2, degree 1, and degree 1 on every coarser mesh;
/// V-cycle and smoother in float, conjugate gradients in double, CHOLMOD at the bottom. One load after the
/// other.
#include "tests/benchmarks/operators/wide_lanes.h"
#include "tests/benchmarks/operators/wide_templates.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>
#include <deal.II/matrix_free/tools.h>
#include <deal.II/multigrid/mg_coarse.h>
#include <deal.II/multigrid/mg_matrix.h>
#include <deal.II/multigrid/mg_smoother.h>
#include <deal.II/multigrid/mg_transfer_global_coarsening.h>
#include <deal.II/multigrid/multigrid.h>

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

#include "tests/benchmarks/operators/wide_multigrid.h"
#include "tests/benchmarks/solvers/process.h"

namespace measure {

namespace {

using dealii::AffineConstraints;
using dealii::DoFHandler;
using dealii::MGLevelObject;
using dealii::Point;
using dealii::Triangulation;
template <typename Number>
using Vector = dealii::LinearAlgebra::distributed::Vector<Number>;

/// A displacement at a vertex that is held.
struct Pin {
  Point<3> at;
  unsigned component;
};

/// A statically determinate support at vertices of the coarse mesh, which all levels have.
std::array<Pin, 6> choose_pins(const Triangulation<3>& mesh) {
  std::vector<Point<3>> corners;
  for (const auto& cell : mesh.cell_iterators_on_level(0))
    for (const auto v : cell->vertex_indices()) corners.push_back(cell->vertex(v));
  const auto largest = [&](const auto& of) {
    return *std::max_element(corners.begin(), corners.end(),
                             [&](const auto& a, const auto& b) { return of(a) < of(b); });
  };
  const auto a = corners.front();
  const auto b = largest([&](const auto& p) { return p.distance_square(a); });
  const auto along = b - a;
  const auto c = largest([&](const auto& p) { return cross_product_3d(along, p - a).norm_square(); });
  const auto component_of = [](const dealii::Tensor<1, 3>& v, unsigned but) {
    unsigned best = but == 0 ? 1 : 0;
    for (unsigned d = 0; d < 3; ++d)
      if (d != but && std::abs(v[d]) > std::abs(v[best])) best = d;
    return best;
  };
  const unsigned main = component_of(along, 3);
  const unsigned around = component_of(cross_product_3d(along, c - a), main);
  return {Pin{a, 0}, Pin{a, 1}, Pin{a, 2}, Pin{b, (main + 1) % 3}, Pin{b, (main + 2) % 3}, Pin{c, around}};
}

/// Displacements of one level, for both precisions.
struct Space {
  Space(const Triangulation<3>& mesh, unsigned degree_, const fem::Grid* shape)
      : degree(degree_), element(dealii::FE_Q<3>(degree_), 3), unknowns(mesh) {
    if (shape != nullptr)
      take_shape(mesh, *shape);
    else
      mapping.initialize(dealii::MappingQ<3>(2), mesh);
    unknowns.distribute_dofs(element);
  }

  template <typename Number>
  void constrain(const std::array<Pin, 6>& pins, AffineConstraints<Number>& constraints) const {
    dealii::DoFTools::make_hanging_node_constraints(unknowns, constraints);
    const double size = unknowns.get_triangulation().begin()->diameter();
    std::array<bool, 6> found{};
    for (const auto& cell : unknowns.active_cell_iterators())
      for (const auto v : cell->vertex_indices())
        for (std::size_t i = 0; i < pins.size(); ++i) {
          if (cell->vertex(v).distance(pins[i].at) > 1e-9 * size) continue;
          found[i] = true;
          const auto unknown = cell->vertex_dof_index(v, pins[i].component);
          if (!constraints.is_constrained(unknown)) constraints.add_line(unknown);
        }
    if (std::count(found.begin(), found.end(), true) != 6)
      throw std::logic_error("a pin is no vertex of a level");
    constraints.close();
  }

  unsigned degree;
  dealii::MappingQCache<3> mapping{2};
  dealii::FESystem<3> element;
  DoFHandler<3> unknowns;

private:
  /// That of our nodes, which hang where deal.II's mapping would leave the larger cell's face.
  void take_shape(const Triangulation<3>& mesh, const fem::Grid& grid) {
    const auto lexicographic = dealii::FETools::hierarchic_to_lexicographic_numbering<3>(2);
    const dealii::FE_Q<3> scalar(2);
    mapping.initialize(mesh, [&](const Triangulation<3>::cell_iterator& cell) {
      std::vector<Point<3>> points(27);
      for (unsigned i = 0; i < 27; ++i) {
        if (cell->is_active()) {
          const auto* x = grid.position(grid.nodes_of(cell->active_cell_index())[lexicographic[i]]);
          points[i] = {x[0], x[1], x[2]};
        } else {  // no space has cells there
          for (const auto v : cell->vertex_indices())
            points[i] += dealii::GeometryInfo<3>::d_linear_shape_function(scalar.unit_support_point(i), v) *
                         cell->vertex(v);
        }
      }
      return points;
    });
  }
};

/// Linear elasticity of one level; constrained unknowns are unit rows.
template <typename Number>
class LevelOperator : public dealii::Subscriptor {
public:
  using value_type = Number;
  using Lanes = WideLanes<Number>;
  using Cells = dealii::MatrixFree<3, Number, Lanes>;

  void reinit(const Space& space, const std::array<Pin, 6>& pins, double lambda, double mu) {
    space_ = &space;
    lambda_ = Number(lambda);
    twice_mu_ = Number(2 * mu);
    space.constrain(pins, constraints);
    typename Cells::AdditionalData options;
    options.tasks_parallel_scheme = Cells::AdditionalData::none;
    options.mapping_update_flags = dealii::update_gradients | dealii::update_JxW_values;
    cells_.reinit(space.mapping, space.unknowns, constraints, dealii::QGauss<1>(space.degree + 1), options);
  }

  dealii::types::global_dof_index m() const { return space_->unknowns.n_dofs(); }
  Number el(unsigned, unsigned) const { return 0; }
  void initialize_dof_vector(Vector<Number>& vector) const { cells_.initialize_dof_vector(vector); }
  void Tvmult(Vector<Number>& to, const Vector<Number>& from) const { vmult(to, from); }
  void vmult(Vector<Number>& to, const Vector<Number>& from) const {
    if (space_->degree == 2)
      cells_.cell_loop(&LevelOperator::template work<2>, this, to, from, true);
    else
      cells_.cell_loop(&LevelOperator::template work<1>, this, to, from, true);
    for (const auto i : cells_.get_constrained_dofs()) to.local_element(i) = from.local_element(i);
  }

  std::shared_ptr<dealii::DiagonalMatrix<Vector<Number>>> inverse_diagonal() const {
    auto result = std::make_shared<dealii::DiagonalMatrix<Vector<Number>>>();
    auto& diagonal = result->get_vector();
    initialize_dof_vector(diagonal);
    if (space_->degree == 2)
      add_diagonal<2>(diagonal);
    else
      add_diagonal<1>(diagonal);
    for (const auto i : cells_.get_constrained_dofs()) diagonal.local_element(i) = 1;
    for (auto& value : diagonal) value = 1 / value;
    return result;
  }

  AffineConstraints<Number> constraints;

private:
  template <unsigned degree>
  using Values = dealii::FEEvaluation<3, degree, degree + 1, 3, Number, Lanes>;

  template <unsigned degree>
  void strain_to_stress(Values<degree>& values) const {
    for (unsigned q = 0; q < values.n_q_points; ++q) {
      const auto strain = values.get_symmetric_gradient(q);
      auto stress = twice_mu_ * strain;
      const auto volume = lambda_ * trace(strain);
      for (int d = 0; d < 3; ++d) stress[d][d] += volume;
      values.submit_symmetric_gradient(stress, q);
    }
  }
  template <unsigned degree>
  void work(const Cells& data, Vector<Number>& to, const Vector<Number>& from,
            const std::pair<unsigned, unsigned>& range) const {
    Values<degree> values(data);
    for (unsigned cell = range.first; cell < range.second; ++cell) {
      values.reinit(cell);
      values.gather_evaluate(from, dealii::EvaluationFlags::gradients);
      strain_to_stress<degree>(values);
      values.integrate_scatter(dealii::EvaluationFlags::gradients, to);
    }
  }
  template <unsigned degree>
  void add_diagonal(Vector<Number>& diagonal) const {
    dealii::MatrixFreeTools::compute_diagonal<3, int(degree), int(degree) + 1, 3, Number, Lanes>(
        cells_, diagonal, [&](auto& values) {
          values.evaluate(dealii::EvaluationFlags::gradients);
          strain_to_stress<degree>(values);
          values.integrate(dealii::EvaluationFlags::gradients);
        });
  }

  const Space* space_ = nullptr;
  Lanes lambda_, twice_mu_;
  Cells cells_;
};

/// The coarsest level's factor.
class Bottom : public dealii::MGCoarseGridBase<Vector<float>> {
public:
  Bottom(const Space& space, const AffineConstraints<float>& constraints, double lambda, double mu) {
    const dealii::QGauss<3> points(space.degree + 1);
    dealii::FEValues<3> values(space.mapping, space.element, points,
                               dealii::update_gradients | dealii::update_JxW_values);
    const auto n = space.element.n_dofs_per_cell();
    std::vector<dealii::types::global_dof_index> of_cell(n);
    std::vector<Eigen::Triplet<double>> entries;
    for (unsigned i = 0; i < space.unknowns.n_dofs(); ++i)
      if (constraints.is_constrained(i)) entries.emplace_back(i, i, 1);
    for (const auto& cell : space.unknowns.active_cell_iterators()) {
      values.reinit(cell);
      cell->get_dof_indices(of_cell);
      for (unsigned a = 0; a < n; ++a)
        for (unsigned b = 0; b < n; ++b) {
          if (constraints.is_constrained(of_cell[a]) || constraints.is_constrained(of_cell[b])) continue;
          const auto i = space.element.system_to_component_index(a).first;
          const auto j = space.element.system_to_component_index(b).first;
          double sum = 0;
          for (unsigned q = 0; q < points.size(); ++q) {
            const auto &u = values.shape_grad(a, q), &v = values.shape_grad(b, q);
            sum += values.JxW(q) * (lambda * u[i] * v[j] + mu * u[j] * v[i] + (i == j ? mu * (u * v) : 0.0));
          }
          entries.emplace_back(of_cell[a], of_cell[b], sum);
        }
    }
    const auto size = Eigen::Index(space.unknowns.n_dofs());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(matrix);
    if (factor_.info() != Eigen::Success) throw std::runtime_error("the coarsest level has no factor");
  }
  void operator()(const unsigned, Vector<float>& to, const Vector<float>& from) const override {
    const Eigen::VectorXd b =
        Eigen::Map<const Eigen::VectorXf>(from.begin(), Eigen::Index(from.locally_owned_size()))
            .cast<double>();
    Eigen::Map<Eigen::VectorXf>(to.begin(), b.size()) = factor_.solve(b).cast<float>();
  }

private:
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> factor_;
};

/// Number in our arrays of each of the level's unknowns: 3 node + component.
std::vector<std::size_t> our_numbers(const Space& space, const fem::Grid& grid) {
  const auto lexicographic = dealii::FETools::hierarchic_to_lexicographic_numbering<3>(2);
  std::vector<std::size_t> result(space.unknowns.n_dofs());
  std::vector<dealii::types::global_dof_index> of_cell(space.element.n_dofs_per_cell());
  for (const auto& cell : space.unknowns.active_cell_iterators()) {
    cell->get_dof_indices(of_cell);
    for (unsigned i = 0; i < of_cell.size(); ++i) {
      const auto [component, node] = space.element.system_to_component_index(i);
      result[of_cell[i]] =
          3 * std::size_t(grid.nodes_of(cell->active_cell_index())[lexicographic[node]]) + component;
    }
  }
  return result;
}

void solve(const MultigridProblem& problem, const MultigridControl& control, MultigridAnswer& answer) {
  const double start_s = cpu_s();
  // Relative to 2 mu: single precision has no room for Pa.
  const double mu = 0.5, lambda = mu * problem.lambda_Pa / problem.mu_Pa, unit_Pa = problem.mu_Pa / mu;

  std::vector<std::unique_ptr<Triangulation<3>>> coarser;  // the finest first
  std::vector<std::unique_ptr<Space>> spaces;              // likewise
  spaces.push_back(std::make_unique<Space>(*problem.mesh, 2, problem.grid));
  spaces.push_back(std::make_unique<Space>(*problem.mesh, 1, problem.grid));
  for (const auto* mesh = problem.mesh; mesh->n_levels() > 1; mesh = coarser.back().get()) {
    coarser.push_back(std::make_unique<Triangulation<3>>(mesh->get_mesh_smoothing()));
    coarser.back()->copy_triangulation(*mesh);
    coarser.back()->coarsen_global();
    spaces.push_back(std::make_unique<Space>(*coarser.back(), 1, nullptr));
  }
  for (const auto& space : spaces) answer.n_dofs.push_back(space->unknowns.n_dofs());
  std::reverse(spaces.begin(), spaces.end());  // as deal.II counts levels
  const unsigned finest = static_cast<unsigned>(spaces.size()) - 1;
  const auto pins = choose_pins(*problem.mesh);

  LevelOperator<double> stiffness;
  stiffness.reinit(*spaces[finest], pins, lambda, mu);
  using Operator = LevelOperator<float>;
  MGLevelObject<Operator> operators(0, finest);
  for (unsigned level = 0; level <= finest; ++level)
    operators[level].reinit(*spaces[level], pins, lambda, mu);
  MGLevelObject<dealii::MGTwoLevelTransfer<3, Vector<float>>> steps(0, finest);
  for (unsigned level = 1; level <= finest; ++level)
    steps[level].reinit(spaces[level]->unknowns, spaces[level - 1]->unknowns, operators[level].constraints,
                        operators[level - 1].constraints);
  using Transfer = dealii::MGTransferGlobalCoarsening<3, Vector<float>>;
  const Transfer transfer(
      steps, [&](unsigned level, Vector<float>& vector) { operators[level].initialize_dof_vector(vector); });

  using Smoother =
      dealii::PreconditionChebyshev<Operator, Vector<float>, dealii::DiagonalMatrix<Vector<float>>>;
  dealii::MGSmootherRelaxation<Operator, Smoother, Vector<float>> smoother;
  MGLevelObject<Smoother::AdditionalData> data(0, finest);
  for (unsigned level = 0; level <= finest; ++level) {
    data[level].smoothing_range = control.smoothing_range;
    data[level].degree = unsigned(control.smoother_degree);
    data[level].eig_cg_n_iterations = 12;
    data[level].preconditioner = operators[level].inverse_diagonal();
  }
  smoother.initialize(operators, data);
  const Bottom bottom(*spaces[0], operators[0].constraints, lambda, mu);
  const dealii::mg::Matrix<Vector<float>> matrices(operators);
  dealii::Multigrid<Vector<float>> cycle(matrices, bottom, transfer, smoother, smoother, 0, finest);
  const dealii::PreconditionMG<3, Vector<float>, Transfer> multigrid(spaces[finest]->unknowns, cycle,
                                                                     transfer);
  answer.set_up_cpu_s = cpu_s() - start_s;

  const auto ours = our_numbers(*spaces[finest], *problem.grid);
  const std::size_t n = 3 * problem.grid->n_nodes;
  answer.n_lanes = int(n_wide_lanes<double>);
  answer.displacement.assign(n * problem.n_loads, 0);
  Vector<double> u, f;
  stiffness.initialize_dof_vector(u);
  stiffness.initialize_dof_vector(f);
  for (std::size_t load = 0; load < problem.n_loads; ++load) {
    const auto* force = problem.force + n * load;
    for (std::size_t i = 0; i < ours.size(); ++i)
      f.local_element(unsigned(i)) = stiffness.constraints.is_constrained(i) ? 0 : force[ours[i]];
    u = 0;
    const double before_s = cpu_s();
    dealii::SolverControl steps_of_load(unsigned(control.max_steps), control.relative_tolerance * f.l2_norm(),
                                        false, false);
    try {
      dealii::SolverCG<Vector<double>>(steps_of_load).solve(stiffness, u, f, multigrid);
    } catch (const dealii::SolverControl::NoConvergence&) {
      answer.converged = false;
    }
    answer.solve_cpu_s += cpu_s() - before_s;
    answer.n_steps = std::max(answer.n_steps, int(steps_of_load.last_step()));
    stiffness.constraints.distribute(u);
    for (std::size_t i = 0; i < ours.size(); ++i)
      answer.displacement[n * load + ours[i]] = u.local_element(unsigned(i)) / unit_Pa;
  }
}

}  // namespace

}  // namespace measure

extern "C" void solve_by_wide_multigrid(const measure::MultigridProblem& problem,
                                        const measure::MultigridControl& control,
                                        measure::MultigridAnswer& answer) {
  measure::solve(problem, control, answer);
}
