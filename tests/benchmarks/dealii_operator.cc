#include "tests/benchmarks/dealii_operator.h"

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <fstream>

#include "fem/mesh/manifolds.h"
#include "fem/operators/stiffness.h"

namespace measure {

namespace {
constexpr int degree = 2;
using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
using Cells = dealii::MatrixFree<3, double>;
}  // namespace

struct DealiiOperator::Impl {
  dealii::Triangulation<3> mesh;
  dealii::FESystem<3> element{dealii::FE_Q<3>(degree), 3};
  dealii::DoFHandler<3> unknowns{mesh};
  dealii::AffineConstraints<double> none;
  Cells cells;
  Vector x, y;
  fem::Lame elastic;

  void work(const Cells& data, Vector& to, const Vector& from,
            const std::pair<unsigned, unsigned>& range) const {
    dealii::FEEvaluation<3, degree, degree + 1, 3, double> values(data);
    const auto lambda = dealii::make_vectorized_array<double>(elastic.lambda_Pa);
    const auto twice_mu = dealii::make_vectorized_array<double>(2 * elastic.mu_Pa);
    for (unsigned cell = range.first; cell < range.second; ++cell) {
      values.reinit(cell);
      values.gather_evaluate(from, dealii::EvaluationFlags::gradients);
      for (unsigned q = 0; q < values.n_q_points; ++q) {
        const auto strain = values.get_symmetric_gradient(q);
        auto stress = twice_mu * strain;
        const auto volume = lambda * trace(strain);
        for (int d = 0; d < 3; ++d) stress[d][d] += volume;
        values.submit_symmetric_gradient(stress, q);
      }
      values.integrate_scatter(dealii::EvaluationFlags::gradients, to);
    }
  }
};

DealiiOperator::DealiiOperator(const fem::Body& body, bool distorted) : impl_(std::make_unique<Impl>()) {
  auto& o = *impl_;
  dealii::GridIn<3> reader(o.mesh);
  std::ifstream file(body.mesh);
  reader.read_msh(file);
  fem::attach_charts(o.mesh, body.cylinders, body.tori);
  if (distorted) dealii::GridTools::distort_random(0.1, o.mesh, true, 1);
  o.unknowns.distribute_dofs(o.element);
  o.none.close();
  o.elastic = fem::lame(body.material);
  Cells::AdditionalData options;
  options.tasks_parallel_scheme = Cells::AdditionalData::none;
  options.mapping_update_flags = dealii::update_gradients | dealii::update_JxW_values;
  dealii::DoFRenumbering::matrix_free_data_locality(o.unknowns, o.none, options);
  o.cells.reinit(dealii::MappingQ<3>(degree), o.unknowns, o.none, dealii::QGauss<1>(degree + 1), options);
  o.cells.initialize_dof_vector(o.x);
  o.cells.initialize_dof_vector(o.y);
  for (auto& value : o.x) value = 1e-3 * double(&value - o.x.begin());
}

OneThread::OneThread() : n_before_(dealii::MultithreadInfo::n_threads()) {
  dealii::MultithreadInfo::set_thread_limit(1);
}

OneThread::~OneThread() {
  dealii::MultithreadInfo::set_thread_limit(n_before_);
}

DealiiOperator::~DealiiOperator() = default;

std::size_t DealiiOperator::n_dofs() const {
  return impl_->unknowns.n_dofs();
}

int DealiiOperator::n_lanes() const {
  return static_cast<int>(dealii::VectorizedArray<double>::size());
}

void DealiiOperator::apply() {
  impl_->cells.cell_loop(&Impl::work, impl_.get(), impl_->y, impl_->x, true);
}

}  // namespace measure
