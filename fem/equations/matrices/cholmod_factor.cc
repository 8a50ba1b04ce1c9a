#include "fem/equations/matrices/cholmod_factor.h"

#include <cholmod.h>
#include <metis.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <string>
#include <vector>

#include "fem/base/common/deadline.h"
#include "fem/base/common/parallel.h"
#include "fem/base/values/cost_constants.h"
#include "fem/base/values/errors.h"

namespace fem {

void refuse_large_graph(std::size_t n_pairs) {
  constexpr auto most = std::size_t(std::numeric_limits<idx_t>::max()) / 2;
  if (n_pairs > most)
    throw DoesNotFit("the mesh has " + std::to_string(n_pairs) +
                     " pairs of neighbouring nodes; METIS, which orders them for the factor, can count " +
                     std::to_string(most) + ": mesh with larger cells, or take a lower degree");
}

std::vector<std::int32_t> order_nodes(const NodeGraph& graph) {
  static_assert(sizeof(idx_t) == sizeof(std::int32_t), "METIS with 32-bit indices is expected");
  refuse_large_graph(graph.neighbour.size());
  idx_t n = static_cast<idx_t>(graph.n_nodes());
  std::vector<idx_t> begin(n + 1, 0);
  for (idx_t j = 0; j < n; ++j) {
    begin[j + 1] += static_cast<idx_t>(graph.begin[j + 1] - graph.begin[j]);
    for (auto k = graph.begin[j]; k < graph.begin[j + 1]; ++k) ++begin[graph.neighbour[k] + 1];
  }
  for (idx_t j = 0; j < n; ++j) begin[j + 1] += begin[j];
  std::vector<idx_t> neighbour(begin[n]), next(begin.begin(), begin.end() - 1);
  for (idx_t j = 0; j < n; ++j)
    for (auto k = graph.begin[j]; k < graph.begin[j + 1]; ++k) {
      neighbour[next[j]++] = graph.neighbour[k];
      neighbour[next[graph.neighbour[k]]++] = j;
    }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> order(n), place(n);
  if (METIS_NodeND(&n, begin.data(), neighbour.data(), nullptr, options, order.data(), place.data()) !=
      METIS_OK)
    throw SolveFailed("METIS could not order the " + std::to_string(n) + " nodes of the mesh");
  return {order.begin(), order.end()};
}

namespace {

/// A lower triangle by columns as CHOLMOD sees it; nothing is copied, and CHOLMOD does not write to it.
/// @param value  null: the pattern alone
cholmod_sparse lower_triangle(std::size_t n, std::size_t n_entries, const void* begin, const void* row,
                              const double* value) {
  cholmod_sparse a{};
  a.nrow = a.ncol = n;
  a.nzmax = n_entries;
  a.p = const_cast<void*>(begin);
  a.i = const_cast<void*>(row);
  a.x = const_cast<double*>(value);
  a.stype = -1;
  a.itype = CHOLMOD_LONG;
  a.xtype = value == nullptr ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

/// The matrix' pattern of nodes: their blocks of 3 x 3 as one entry each.
struct NodePattern {
  std::vector<SuiteSparse_long> begin, row;
};

NodePattern pattern_of_nodes(const NodeGraph& graph) {
  NodePattern pattern;
  pattern.begin.reserve(graph.n_nodes() + 1);
  pattern.row.reserve(graph.n_nodes() + graph.neighbour.size());
  for (std::size_t j = 0; j < graph.n_nodes(); ++j) {
    pattern.begin.push_back(SuiteSparse_long(pattern.row.size()));
    pattern.row.push_back(SuiteSparse_long(j));
    for (auto k = graph.begin[j]; k < graph.begin[j + 1]; ++k) pattern.row.push_back(graph.neighbour[k]);
  }
  pattern.begin.push_back(SuiteSparse_long(pattern.row.size()));
  return pattern;
}

/// Writes to each page of new memory, on all threads. A virtual machine hands out half a gigabyte a second to
/// one of them: that was two thirds of a factorisation's time.
void touch(Eigen::ArrayXd& memory) {
  constexpr std::size_t page = 4096 / sizeof(double);
  parallel_for(std::size_t(memory.size()) / page, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) memory[Eigen::Index(page * k)] = 0;
  });
}

double factorisation_s(double flops) {
  return flops *
         (flops < flops_worth_threads ? cost::factor_s_per_flop_alone : cost::factor_s_per_flop_shared);
}

}  // namespace

struct CholmodFactor::Impl {
  double matrix_bytes = 0;
  std::vector<std::int32_t> node_order;  ///< CHOLMOD's own: postordered
  mutable cholmod_common common{};
  cholmod_factor* factor = nullptr;
  Eigen::ArrayXd entries;  ///< the factor's: not CHOLMOD's to free

  Impl() {
    cholmod_l_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.supernodal = CHOLMOD_SUPERNODAL;
    for (auto& columns : common.nrelax) columns = (columns + 2) / 3;  // counted in nodes
  }
  ~Impl() {
    if (factor != nullptr) factor->x = nullptr;
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }
  void check(const char* step) const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
      throw SolveFailed(std::string("not enough memory to ") + step + " the stiffness: use a coarser mesh");
    if (common.status < CHOLMOD_OK)
      throw SolveFailed(std::string("CHOLMOD could not ") + step + " the stiffness (status " +
                        std::to_string(common.status) + ")");
  }
};

namespace {

/// The supernodal factor of a matrix whose nodes have three unknowns each, from that of its pattern of nodes:
/// their columns have the same rows below them.
/// @return null if there is no memory, which `common` tells
cholmod_factor* of_three_unknowns(const cholmod_factor& nodes, cholmod_common& common) {
  cholmod_factor* factor = cholmod_l_allocate_factor(3 * nodes.n, &common);
  if (factor == nullptr) return nullptr;
  factor->is_super = factor->is_ll = 1;
  factor->ordering = nodes.ordering;
  factor->nsuper = nodes.nsuper;
  factor->ssize = 3 * nodes.ssize;
  factor->maxcsize = 9 * nodes.maxcsize;
  factor->maxesize = 3 * nodes.maxesize;
  const auto make = [&](std::size_t n) {
    return static_cast<SuiteSparse_long*>(cholmod_l_malloc(n, sizeof(SuiteSparse_long), &common));
  };
  auto *const super = make(nodes.nsuper + 1), *const pi = make(nodes.nsuper + 1),
              *const px = make(nodes.nsuper + 1), *const rows = make(factor->ssize);
  factor->super = super;
  factor->pi = pi;
  factor->px = px;
  factor->s = rows;
  if (common.status < CHOLMOD_OK) {
    cholmod_l_free_factor(&factor, &common);
    return nullptr;
  }
  const auto values = [](const void* array) { return static_cast<const SuiteSparse_long*>(array); };
  px[0] = 0;
  for (std::size_t k = 0; k <= nodes.nsuper; ++k) {
    super[k] = 3 * values(nodes.super)[k];
    pi[k] = 3 * values(nodes.pi)[k];
    if (k > 0) px[k] = px[k - 1] + (super[k] - super[k - 1]) * (pi[k] - pi[k - 1]);
  }
  factor->xsize = std::size_t(px[nodes.nsuper]);
  auto *const order = static_cast<SuiteSparse_long*>(factor->Perm), *const count =
                                                                        static_cast<SuiteSparse_long*>(
                                                                            factor->ColCount);
  for (std::size_t j = 0; j < nodes.n; ++j)
    for (int d = 0; d < 3; ++d) {
      order[3 * j + d] = 3 * values(nodes.Perm)[j] + d;
      count[3 * j + d] = 3 * values(nodes.ColCount)[j] - d;
    }
  for (std::size_t i = 0; i < nodes.ssize; ++i)
    for (int d = 0; d < 3; ++d) rows[3 * i + d] = 3 * values(nodes.s)[i] + d;
  return factor;
}

}  // namespace

CholmodFactor::CholmodFactor(const NodeGraph& graph, const std::vector<std::int32_t>& node_order)
    : impl_(std::make_unique<Impl>()) {
  static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t), "CHOLMOD with 64-bit indices is expected");
  const SerialOpenMp serial;
  auto& common = impl_->common;
  impl_->matrix_bytes = 16.0 * (9.0 * double(graph.neighbour.size()) + 6.0 * double(graph.n_nodes()));
  const auto pattern = pattern_of_nodes(graph);
  auto a =
      lower_triangle(graph.n_nodes(), pattern.row.size(), pattern.begin.data(), pattern.row.data(), nullptr);
  std::vector<SuiteSparse_long> order(node_order.begin(), node_order.end());
  cholmod_factor* nodes = cholmod_l_analyze_p(&a, order.data(), nullptr, 0, &common);
  impl_->check("analyse");
  const auto* const in_order = static_cast<const SuiteSparse_long*>(nodes->Perm);
  impl_->node_order.assign(in_order, in_order + nodes->n);
  impl_->factor = of_three_unknowns(*nodes, common);
  cholmod_l_free_factor(&nodes, &common);
  impl_->check("analyse");
}

CholmodFactor::~CholmodFactor() = default;

const std::vector<std::int32_t>& CholmodFactor::node_order() const {
  return impl_->node_order;
}

void CholmodFactor::take_memory() {
  auto& factor = *impl_->factor;
  if (factor.xtype != CHOLMOD_PATTERN) return;
  try {
    impl_->entries.resize(Eigen::Index(factor.xsize));
  } catch (const std::bad_alloc&) {
    impl_->common.status = CHOLMOD_OUT_OF_MEMORY;
  }
  impl_->check("factorise");
  touch(impl_->entries);
  factor.x = impl_->entries.data();
  factor.xtype = CHOLMOD_REAL;
  factor.dtype = CHOLMOD_DOUBLE;
  factor.minor = factor.n;
}

void CholmodFactor::factorise(const SymmetricMatrix& matrix) {
  // CHOLMOD's own way into this order transposes the matrix twice, on one thread.
  factorise_in_order(permuted(matrix, impl_->node_order));
}

void CholmodFactor::factorise_in_order(const SymmetricMatrix& matrix) {
  const SerialOpenMp serial;
  auto a = lower_triangle(std::size_t(matrix.n), std::size_t(matrix.value.size()), matrix.column_begin.data(),
                          matrix.row.data(), matrix.value.data());
  auto& factor = *impl_->factor;
  const double predicted_s = factorisation_s(size().flops);
  require_time(at_present_pace(predicted_s));
  take_memory();
  double no_shift[2] = {0, 0};
  const auto start = std::chrono::steady_clock::now();
  cholmod_l_super_numeric(&a, nullptr, no_shift, &factor, &impl_->common);
  note_pace(predicted_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  impl_->check("factorise");
  if (impl_->common.status == CHOLMOD_NOT_POSDEF || factor.minor < factor.n)
    throw SolveFailed(
        "the stiffness is not positive definite: the mesh may fall into parts that do not touch, or has "
        "degenerate cells");
}

namespace {

/// Solves for some columns in place, on the calling thread with a work space of its own: it reads the factor
/// alone.
/// @param columns  rows in the factor's order
/// @return empty, or what went wrong
std::string solve_columns(cholmod_factor* factor, Eigen::Ref<Eigen::MatrixXd> columns) {
  const SerialOpenMp serial;
  cholmod_common common{};
  cholmod_l_start(&common);
  common.print = 0;
  cholmod_dense x{};
  x.nrow = std::size_t(columns.rows());
  x.d = std::size_t(columns.outerStride());
  x.ncol = std::size_t(columns.cols());
  x.nzmax = x.d * x.ncol;
  x.x = columns.data();
  x.xtype = CHOLMOD_REAL;
  x.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* work = cholmod_l_allocate_dense(x.ncol, factor->maxesize, x.ncol, CHOLMOD_REAL, &common);
  const bool solved = work != nullptr && cholmod_l_super_lsolve(factor, &x, work, &common) != 0 &&
                      cholmod_l_super_ltsolve(factor, &x, work, &common) != 0;
  std::string failure;
  if (!solved)
    failure = common.status == CHOLMOD_OUT_OF_MEMORY
                  ? "not enough memory to solve with the stiffness: use a coarser mesh"
                  : "CHOLMOD could not solve (status " + std::to_string(common.status) + ")";
  cholmod_l_free_dense(&work, &common);
  cholmod_l_finish(&common);
  return failure;
}

}  // namespace

void CholmodFactor::solve_in_order(Eigen::MatrixXd& columns) const {
  const SerialBlas serial;
  constexpr Eigen::Index most_columns = 16;  // whatever the threads: the sums stay the same
  const auto n = columns.cols();
  const auto n_blocks = std::size_t((n + most_columns - 1) / most_columns);
  std::vector<std::string> failures(n_blocks);
  parallel_for(n_blocks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Eigen::Index first = most_columns * Eigen::Index(k);
      failures[k] =
          solve_columns(impl_->factor, columns.middleCols(first, std::min(most_columns, n - first)));
    }
  });
  for (const auto& failure : failures)
    if (!failure.empty()) throw SolveFailed(failure);
}

Eigen::MatrixXd CholmodFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  const auto place = places_in(impl_->node_order);
  Eigen::MatrixXd columns = rows_in_order(right_hand_sides, place);
  solve_in_order(columns);
  return rows_of_mesh(columns, place);
}

double CholmodFactor::gigabytes() const {
  const auto& l = *impl_->factor;
  return 1e-9 *
         (8.0 * double(l.xsize) + 8.0 * double(l.ssize) + 24.0 * double(l.nsuper) + 16.0 * double(l.n));
}

FactorSize CholmodFactor::size() const {
  const auto& l = *impl_->factor;
  const auto* const count = static_cast<const SuiteSparse_long*>(l.ColCount);
  const double flops = std::accumulate(count, count + l.n, 0.0,
                                       [](double sum, auto c) { return sum + double(c) * double(c); });
  return {l.n, double(l.xsize), flops, 1e9 * gigabytes() + impl_->matrix_bytes};
}

}  // namespace fem
