/// MatrixFree with the lanes of one instruction set: a shared object of its own, which gives away one
/// function. What it instantiates of deal.II's inline code has those instructions, and stays inside
/// (wide_matrix_free.map): neither side can take a weak symbol of the other.
#include "tests/benchmarks/wide_lanes.h"

// The library has these templates for one lane only. Degree 2 is all that is asked for; the others would
// double the time to compile.
#define FE_EVAL_FACTORY_DEGREE_MAX 2
#include <deal.II/matrix_free/evaluation_template_factory.templates.h>
// deal.II 9.4 guards both files by one name.
#undef dealii_matrix_free_evaluation_template_factory_templates_h
#include <deal.II/matrix_free/evaluation_template_face_factory.templates.h>
#include <deal.II/matrix_free/evaluation_template_factory_hanging_nodes.templates.h>
#include <deal.II/matrix_free/mapping_info.templates.h>
#include <deal.II/matrix_free/matrix_free.templates.h>
#include <deal.II/matrix_free/shape_info.templates.h>

#include "tests/benchmarks/elastic_matrix_free.h"
#include "tests/benchmarks/wide_matrix_free.h"

extern "C" measure::MatrixFreeProduct* make_wide_matrix_free(
    const dealii::DoFHandler<3>& unknowns, const dealii::AffineConstraints<double>& constraints,
    double lambda_Pa, double mu_Pa) {
  return new measure::ElasticMatrixFree<measure::WideLanes>(unknowns, constraints, lambda_Pa, mu_Pa);
}
