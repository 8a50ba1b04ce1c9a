#include "fem/multigrid/coarse_on_last_rank.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "fem/common/memory.h"
#include "fem/ranks/arrays.h"
#include "fem/ranks/ranks.h"

namespace fem {

namespace {

constexpr int coarse_tag = 3;

/// What a rank brings, beside its matrix.
struct Part {
  Grid grid;
  std::vector<std::int32_t> corner;
};

/// The arrays of a part of a corner mesh, each handed to `use`.
template <typename OfPart, typename Use>
void for_arrays(OfPart& part, const Use& use) {
  use(part.corner);
  use(part.grid.xyz_m);
  use(part.grid.cell_nodes);
  use(part.grid.volume_id);
  use(part.grid.hanging.node);
  use(part.grid.hanging.begin);
  use(part.grid.hanging.master);
  use(part.grid.hanging.weight);
}

Part receive_part(CellKind kind, int from, MPI_Comm communicator) {
  Part part;
  for_arrays(part, [&](auto& array) { receive_array(array, from, communicator); });
  part.grid.kind = kind;
  part.grid.degree = 1;
  part.grid.n_nodes = part.corner.size();
  return part;
}

void send_matrix(const SymmetricMatrix& matrix, int to, MPI_Comm communicator) {
  send_array(matrix.column_begin, to, communicator);
  send_array(matrix.row, to, communicator);
  send_array(matrix.value, to, communicator);
}

SymmetricMatrix receive_matrix(int from, MPI_Comm communicator) {
  SymmetricMatrix matrix;
  receive_array(matrix.column_begin, from, communicator);
  receive_array(matrix.row, from, communicator);
  receive_array(matrix.value, from, communicator);
  matrix.n = std::int64_t(matrix.column_begin.size()) - 1;
  return matrix;
}

/// One mesh of the parts' cells; nodes in the order in which the parts have them.
Grid join(const std::vector<Part>& parts, std::vector<std::vector<std::int32_t>>& node) {
  Grid grid;
  grid.kind = parts.front().grid.kind;
  grid.degree = 1;
  std::unordered_map<std::int32_t, std::int32_t> number;
  std::map<std::int32_t, std::vector<std::pair<std::int32_t, double>>> masters;  // of hanging corners
  for (const auto& part : parts) {
    auto& own = node.emplace_back();
    for (std::size_t i = 0; i < part.corner.size(); ++i) {
      const auto [found, is_new] = number.emplace(part.corner[i], static_cast<std::int32_t>(grid.n_nodes));
      own.push_back(found->second);
      if (!is_new) continue;
      ++grid.n_nodes;
      grid.xyz_m.insert(grid.xyz_m.end(), part.grid.position(std::int32_t(i)),
                        part.grid.position(std::int32_t(i)) + 3);
    }
    for (const auto i : part.grid.cell_nodes) grid.cell_nodes.push_back(own[i]);
    grid.volume_id.insert(grid.volume_id.end(), part.grid.volume_id.begin(), part.grid.volume_id.end());
    const auto& hanging = part.grid.hanging;
    for (std::size_t i = 0; i < hanging.n(); ++i) {
      auto& known = masters[own[hanging.node[i]]];
      if (!known.empty()) continue;  // every part that has the corner says the same
      for (auto k = hanging.begin[i]; k < hanging.begin[i + 1]; ++k)
        known.emplace_back(own[hanging.master[k]], hanging.weight[k]);
    }
  }
  for (const auto& [corner, known] : masters) grid.hanging.add(corner, known);
  return grid;
}

void add(const SymmetricMatrix& part, const std::vector<std::int32_t>& node, const NodeGraph& graph,
         SymmetricMatrix& matrix) {
  for (std::size_t j = 0; j < node.size(); ++j)
    for_blocks_of(part, j, [&](std::int32_t i, const Eigen::Matrix3d& block) {
      add_block(graph, node[std::size_t(i)], node[j], block, matrix);
    });
}

/// Adds (or copies back) the rows of a rank's nodes to those of all.
template <typename Whole, typename Own, typename Use>
void for_rows(const Lanes& lanes, const std::vector<std::int32_t>& node, std::size_t n_whole, Whole* whole,
              Own* own, const Use& use) {
  for (const auto& group : lanes.groups) {
    const auto width = 3 * std::size_t(group.width);
    auto* to = whole + 3 * n_whole * group.first_lane;
    auto* from = own + 3 * node.size() * group.first_lane;
    for (std::size_t i = 0; i < node.size(); ++i)
      for (std::size_t l = 0; l < width; ++l) use(to[node[i] * width + l], from[i * width + l]);
  }
}

}  // namespace

CoarseOnLastRank::CoarseOnLastRank(MPI_Comm communicator, const Grid& coarse,
                                   const std::vector<std::int32_t>& corner, const SymmetricMatrix& matrix,
                                   CoarseLevel level, const kernel::Kernels& kernels)
    : communicator_(communicator) {
  const int last = n_ranks(communicator) - 1;
  const bool is_last = this_rank(communicator) == last;
  std::vector<Part> parts;
  if (is_last) {
    for (int r = 0; r < last; ++r) parts.push_back(receive_part(coarse.kind, r, communicator));
    parts.push_back({coarse, corner});
  } else {
    const Part part{coarse, corner};
    for_arrays(part, [&](const auto& array) { send_array(array, last, communicator); });
    send_matrix(matrix, last, communicator);
  }
  int next = 0;  // whose matrix comes next: one after the other, since all have as much as their sum
  const auto build = [&] {
    const Grid joined = join(parts, node_);
    parts.clear();
    const NodeGraph graph = make_node_graph(joined, cells_of_nodes(joined));
    const auto assemble = [&] {
      SymmetricMatrix sum = make_matrix(graph);
      for (; next < last; ++next)
        add(receive_matrix(next, communicator), node_[std::size_t(next)], graph, sum);
      add(matrix, node_.back(), graph, sum);
      return sum;
    };
    solver_ = std::make_unique<CoarseSolver>(joined, graph, assemble, level, kernels);
  };
  agree(communicator, [&] {
    if (!is_last) return;
    try {
      build();
    } catch (...) {
      for (; next < last; ++next) receive_matrix(next, communicator);  // they wait for that
      throw;
    }
  });
  if (is_last) release_free_memory();  // of what was joined: the operator comes next
}

CoarseOnLastRank::WorkSpace CoarseOnLastRank::work_space(const Lanes& lanes) const {
  if (!solver_) return {};
  return {{solver_->n_nodes(), lanes}, {solver_->n_nodes(), lanes}, solver_->work_space(lanes)};
}

void CoarseOnLastRank::solve(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                             WorkSpace& work) const {
  const auto size = [&](std::size_t n_nodes) {
    const std::size_t n = 3 * n_nodes * lanes.n_lanes;
    if (n > std::size_t(std::numeric_limits<int>::max()))
      throw SolveFailed("the trilinear level of one MPI rank has " + std::to_string(n) +
                        " numbers, more than one message takes: start the program on more ranks");
    return static_cast<int>(n);
  };
  const int last = n_ranks(communicator_) - 1;
  if (!solver_) {
    MPI_Send(b.data(), size(b.n_nodes()), MPI_FLOAT, last, coarse_tag, communicator_);
    MPI_Recv(x.data(), size(x.n_nodes()), MPI_FLOAT, last, coarse_tag, communicator_, MPI_STATUS_IGNORE);
    return;
  }
  const std::size_t n = solver_->n_nodes();
  std::fill_n(work.force.data(), 3 * n * lanes.n_lanes, 0.0f);
  std::vector<float> received;
  for (int r = 0; r <= last; ++r) {
    const auto& node = node_[std::size_t(r)];
    const float* from = b.data();
    if (r < last) {
      received.resize(size(node.size()));
      MPI_Recv(received.data(), size(node.size()), MPI_FLOAT, r, coarse_tag, communicator_,
               MPI_STATUS_IGNORE);
      from = received.data();
    }
    for_rows(lanes, node, n, work.force.data(), from, [](float& to, float value) { to += value; });
  }
  solver_->solve(lanes, work.force, work.displacement, work.below);
  const float* whole = work.displacement.data();
  for (int r = 0; r <= last; ++r) {
    const auto& node = node_[std::size_t(r)];
    received.resize(size(node.size()));
    float* to = r < last ? received.data() : x.data();
    for_rows(lanes, node, n, whole, to, [](float value, float& own) { own = value; });
    if (r < last) MPI_Send(to, size(node.size()), MPI_FLOAT, r, coarse_tag, communicator_);
  }
}

}  // namespace fem
