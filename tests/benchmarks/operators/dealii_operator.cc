#include "tests/benchmarks/operators/dealii_operator.h"

#include <deal.II/base/multithread_info.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <dlfcn.h>

#include <stdexcept>
#include <string>

#include "fem/operators/stiffness.h"
#include "fem/triangulation/manifolds.h"
#include "fem/triangulation/triangulation.h"
#include "tests/benchmarks/operators/elastic_matrix_free.h"
#include "tests/benchmarks/operators/wide_matrix_free.h"

namespace measure {

namespace {

/// As Debian builds deal.II: one.
using PackagedLanes = dealii::VectorizedArray<double>;

/// The shared objects of the build whose instructions this machine has.
std::vector<std::string> wide_libraries() {
  std::vector<std::string> files;
#if defined(MATRIX_FREE_AVX2)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    files.push_back(MATRIX_FREE_AVX2);
#endif
#if defined(MATRIX_FREE_AVX512)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    files.push_back(MATRIX_FREE_AVX512);
#endif
  return files;
}

/// The library stays loaded until the program ends.
decltype(&make_wide_matrix_free) maker_in(const std::string& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const maker = library ? dlsym(library, "make_wide_matrix_free") : nullptr;
  if (!maker) throw std::runtime_error(std::string("MatrixFree with more lanes: ") + dlerror());
  return reinterpret_cast<decltype(&make_wide_matrix_free)>(maker);
}

}  // namespace

struct DealiiOperator::Impl {
  dealii::Triangulation<3> mesh;
  dealii::FESystem<3> element{dealii::FE_Q<3>(matrix_free_degree), 3};
  dealii::DoFHandler<3> unknowns{mesh};
  dealii::AffineConstraints<double> none;
  fem::Lame elastic;
};

DealiiOperator::DealiiOperator(const fem::Body& body, bool distorted) : impl_(std::make_unique<Impl>()) {
  auto& o = *impl_;
  fem::triangulate(*body.mesh, o.mesh);
  fem::attach_charts(o.mesh, body.cylinders, body.tori);
  if (distorted) dealii::GridTools::distort_random(0.1, o.mesh, true, 1);
  o.unknowns.distribute_dofs(o.element);
  o.none.close();
  o.elastic = fem::lame(body.material);
  dealii::DoFRenumbering::matrix_free_data_locality(o.unknowns, o.none,
                                                    ElasticMatrixFree<PackagedLanes>::options());
}

DealiiOperator::~DealiiOperator() = default;

void DealiiOperator::place_nodes(fem::Grid& grid) const {
  const dealii::FE_Q<3> scalar(matrix_free_degree);
  std::vector<dealii::Point<3>> points;
  for (const auto i : dealii::FETools::lexicographic_to_hierarchic_numbering<3>(matrix_free_degree))
    points.push_back(scalar.get_unit_support_points()[i]);
  const dealii::MappingQ<3> mapping(matrix_free_degree);
  dealii::FEValues<3> values(mapping, scalar, dealii::Quadrature<3>(points),
                             dealii::update_quadrature_points);
  auto node = grid.cell_nodes.begin();  // cells of both are in the order of the mesh
  for (const auto& cell : impl_->mesh.active_cell_iterators()) {
    values.reinit(cell);
    for (const auto& point : values.get_quadrature_points()) {
      for (int d = 0; d < 3; ++d) grid.xyz_m[3 * std::size_t(*node) + d] = point[d];
      ++node;
    }
  }
}

std::vector<std::size_t> DealiiOperator::unknowns_of(const fem::Grid& grid) const {
  const auto& element = impl_->element;
  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(matrix_free_degree);
  std::vector<std::size_t> result(3 * grid.n_nodes);
  std::vector<dealii::types::global_dof_index> of_cell(element.n_dofs_per_cell());
  auto node = grid.cell_nodes.begin();
  for (const auto& cell : impl_->unknowns.active_cell_iterators()) {
    cell->get_dof_indices(of_cell);
    for (const auto i : hierarchic) {
      for (unsigned d = 0; d < 3; ++d)
        result[3 * std::size_t(*node) + d] = of_cell[element.component_to_system_index(d, i)];
      ++node;
    }
  }
  return result;
}

std::unique_ptr<MatrixFreeProduct> DealiiOperator::one_lane() const {
  return std::make_unique<ElasticMatrixFree<PackagedLanes>>(impl_->unknowns, impl_->none,
                                                            impl_->elastic.lambda_Pa, impl_->elastic.mu_Pa);
}

std::vector<std::unique_ptr<MatrixFreeProduct>> DealiiOperator::wide() const {
  std::vector<std::unique_ptr<MatrixFreeProduct>> products;
  for (const auto& file : wide_libraries())
    products.emplace_back(
        maker_in(file)(impl_->unknowns, impl_->none, impl_->elastic.lambda_Pa, impl_->elastic.mu_Pa));
  return products;
}

OneThread::OneThread() : n_before_(dealii::MultithreadInfo::n_threads()) {
  dealii::MultithreadInfo::set_thread_limit(1);
}

OneThread::~OneThread() {
  dealii::MultithreadInfo::set_thread_limit(n_before_);
}

}  // namespace measure
