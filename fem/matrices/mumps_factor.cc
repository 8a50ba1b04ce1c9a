#include "fem/matrices/mumps_factor.h"

#include <dmumps_c.h>

#include <string>

#include "fem/ranks/ranks.h"

namespace fem {

struct MumpsFactor::Impl {
  mutable DMUMPS_STRUC_C data{};
  MPI_Comm communicator;
  bool first;

  static_assert(sizeof(MUMPS_INT) == sizeof(std::int32_t), "MUMPS with 32-bit indices is expected");

  explicit Impl(MPI_Comm of) : communicator(of), first(this_rank(of) == 0) {
    constexpr int positive_definite = 1;
    data.par = 1;
    data.sym = positive_definite;
    data.comm_fortran = MPI_Comm_c2f(of);
    run(-1);
    for (int i = 1; i <= 4; ++i) control(i) = i == 4 ? 0 : -1;  // no output
    control(18) = 3;                                            // entries from all ranks
    control(7) = 1;                                             // the ordering is given
    control(28) = 1;
    control(14) = 40;  // % more work space than estimated
  }
  ~Impl() { run(-2); }

  MUMPS_INT& control(int number) const { return data.icntl[number - 1]; }
  int status() const { return data.infog[0]; }
  void run(int job) const {
    data.job = job;
    dmumps_c(&data);
  }
  /// INFOG is the same on all ranks, so that all of them throw.
  void check(const char* step) const {
    if (status() >= 0) return;
    constexpr int not_definite = -10, not_definite_at_root = -40, no_memory = -13;
    if (status() == not_definite || status() == not_definite_at_root)
      throw FailedTogether(
          "the stiffness is not positive definite: the mesh may fall into parts that do not touch, or has "
          "degenerate cells");
    if (status() == no_memory || is_short_of_work_space())
      throw FailedTogether(std::string("not enough memory to ") + step +
                           " the stiffness: use a coarser mesh, or ranks on more machines");
    throw FailedTogether(std::string("MUMPS could not ") + step + " the stiffness (INFOG " +
                         std::to_string(status()) + ", " + std::to_string(data.infog[1]) + ")");
  }
  bool is_short_of_work_space() const { return status() == -8 || status() == -9 || status() == -20; }
};

MumpsFactor::MumpsFactor(MPI_Comm communicator, std::int64_t n, const SymmetricMatrix& matrix,
                         const std::vector<std::int32_t>& node, const std::vector<std::int32_t>& node_order)
    : impl_(std::make_unique<Impl>(communicator)) {
  constexpr int analyse = 1, factorise = 2, most_attempts = 4;
  auto& data = impl_->data;
  std::vector<MUMPS_INT> row, column, position;
  agree(communicator, [&] {
    const auto unknown = [&](std::int64_t i) { return 3 * node[i / 3] + static_cast<MUMPS_INT>(i % 3) + 1; };
    row.reserve(matrix.value.size());
    column.reserve(matrix.value.size());
    for (std::int64_t j = 0; j < matrix.n; ++j)
      for (auto k = matrix.column_begin[j]; k < matrix.column_begin[j + 1]; ++k) {
        row.push_back(unknown(matrix.row[k]));
        column.push_back(unknown(j));
      }
    if (impl_->first) position.resize(n);
    for (std::size_t p = 0; p < node_order.size(); ++p)
      for (int d = 0; d < 3; ++d)
        position[3 * std::size_t(node_order[p]) + d] = static_cast<MUMPS_INT>(3 * p + d + 1);
  });
  data.n = static_cast<MUMPS_INT>(n);
  data.nnz_loc = static_cast<MUMPS_INT8>(matrix.value.size());
  data.irn_loc = row.data();
  data.jcn_loc = column.data();
  data.a_loc = const_cast<double*>(matrix.value.data());
  data.perm_in = position.data();
  impl_->run(analyse);
  impl_->check("analyse");
  impl_->run(factorise);
  for (int attempt = 1; attempt < most_attempts && impl_->is_short_of_work_space(); ++attempt) {
    impl_->control(14) *= 2;
    impl_->run(factorise);
  }
  impl_->check("factorise");
  data.irn_loc = data.jcn_loc = data.perm_in = nullptr;
  data.a_loc = nullptr;
}

MumpsFactor::~MumpsFactor() = default;

void MumpsFactor::solve(Eigen::MatrixXd& columns) const {
  constexpr int solve = 3;
  auto& data = impl_->data;
  data.nrhs = static_cast<MUMPS_INT>(columns.cols());
  data.lrhs = data.n;
  data.rhs = columns.data();
  impl_->control(27) = 32;  // right-hand sides at a time
  impl_->run(solve);
  impl_->check("solve with");
}

double MumpsFactor::bytes() const {
  const double entries = impl_->data.info[8];  // negative: millions
  return 8 * (entries < 0 ? -1e6 * entries : entries);
}

}  // namespace fem
