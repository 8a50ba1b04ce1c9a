/// Linear elasticity of degree 2 written with deal.II's MatrixFree, for any number of lanes.
#pragma once

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <utility>

#include "tests/benchmarks/operators/matrix_free_product.h"

namespace measure {

constexpr int matrix_free_degree = 2;

/// @param Lanes  a VectorizedArray<double, n>
template <typename Lanes>
class ElasticMatrixFree : public MatrixFreeProduct {
public:
  using Cells = dealii::MatrixFree<3, double, Lanes>;

  static typename Cells::AdditionalData options() {
    typename Cells::AdditionalData options;
    options.tasks_parallel_scheme = Cells::AdditionalData::none;
    options.mapping_update_flags = dealii::update_gradients | dealii::update_JxW_values;
    return options;
  }

  /// @param lambda_Pa, mu_Pa  Lame's constants
  ElasticMatrixFree(const dealii::DoFHandler<3>& unknowns,
                    const dealii::AffineConstraints<double>& constraints, double lambda_Pa, double mu_Pa)
      : lambda_(lambda_Pa), twice_mu_(2 * mu_Pa) {
    cells_.reinit(dealii::MappingQ<3>(matrix_free_degree), unknowns, constraints,
                  dealii::QGauss<1>(matrix_free_degree + 1), options());
    cells_.initialize_dof_vector(x_);
    cells_.initialize_dof_vector(y_);
  }

  int n_lanes() const override { return static_cast<int>(Lanes::size()); }
  std::size_t n_dofs() const override { return x_.size(); }
  double* x() override { return x_.begin(); }
  const double* y() const override { return y_.begin(); }
  void apply() override { cells_.cell_loop(&ElasticMatrixFree::work, this, y_, x_, true); }

private:
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  void work(const Cells& data, Vector& to, const Vector& from,
            const std::pair<unsigned, unsigned>& range) const {
    dealii::FEEvaluation<3, matrix_free_degree, matrix_free_degree + 1, 3, double, Lanes> values(data);
    for (unsigned cell = range.first; cell < range.second; ++cell) {
      values.reinit(cell);
      values.gather_evaluate(from, dealii::EvaluationFlags::gradients);
      for (unsigned q = 0; q < values.n_q_points; ++q) {
        const auto strain = values.get_symmetric_gradient(q);
        auto stress = twice_mu_ * strain;
        const auto volume = lambda_ * trace(strain);
        for (int d = 0; d < 3; ++d) stress[d][d] += volume;
        values.submit_symmetric_gradient(stress, q);
      }
      values.integrate_scatter(dealii::EvaluationFlags::gradients, to);
    }
  }

  Lanes lambda_, twice_mu_;
  Cells cells_;
  Vector x_, y_;
};

}  // namespace measure
