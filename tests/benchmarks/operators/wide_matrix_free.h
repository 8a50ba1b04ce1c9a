/// The one function of the shared objects that wide_matrix_free.cc becomes.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include "tests/benchmarks/operators/matrix_free_product.h"

/// @param unknowns, constraints  outlive the product
/// @param lambda_Pa, mu_Pa       Lame's constants
/// @return to be deleted
extern "C" measure::MatrixFreeProduct* make_wide_matrix_free(
    const dealii::DoFHandler<3>& unknowns, const dealii::AffineConstraints<double>& constraints,
    double lambda_Pa, double mu_Pa);
