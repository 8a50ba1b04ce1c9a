/// MatrixFree with the lanes of one instruction set: a shared object of its own, which gives away one
/// function. What it instantiates of deal.II's inline code has those instructions, and stays inside
/// (wide_matrix_free.map): neither side can take a weak symbol of the other.
#include "tests/benchmarks/operators/wide_lanes.h"

#include "tests/benchmarks/operators/wide_templates.h"

#include "tests/benchmarks/operators/elastic_matrix_free.h"
#include "tests/benchmarks/operators/wide_matrix_free.h"

extern "C" measure::MatrixFreeProduct* make_wide_matrix_free(
    const dealii::DoFHandler<3>& unknowns, const dealii::AffineConstraints<double>& constraints,
    double lambda_Pa, double mu_Pa) {
  return new measure::ElasticMatrixFree<measure::WideLanes<double>>(unknowns, constraints, lambda_Pa, mu_Pa);
}
