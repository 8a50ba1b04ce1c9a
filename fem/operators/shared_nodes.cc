#include "fem/operators/shared_nodes.h"

#include <algorithm>
#include <map>
#include <utility>

#include "fem/ranks/array_sums.h"

namespace fem {

namespace {

constexpr int shared_nodes_tag = 2;
/// MPI counts the bytes of a message in 31 bits.
constexpr std::size_t values_per_message = std::size_t(1) << 27;

/// Calls use(first of the node's numbers, how many) for each group of lanes.
template <typename T, typename Use>
void for_node(const Lanes& lanes, T* data, std::size_t n_nodes, std::size_t node, const Use& use) {
  for (const auto& group : lanes.groups) {
    const auto width = std::size_t(group.width);
    use(data + 3 * (n_nodes * group.first_lane + node * width), 3 * width);
  }
}

template <typename T>
void append(const Lanes& lanes, const BlockVector<T>& vector, std::size_t node, std::vector<T>& to) {
  for_node(lanes, vector.data(), vector.n_nodes(), node,
           [&](const T* values, std::size_t n) { to.insert(to.end(), values, values + n); });
}

}  // namespace

SharedNodes::SharedNodes(MPI_Comm communicator, std::vector<Neighbour> neighbours, std::size_t n_counted,
                         std::vector<std::int32_t> body_node)
    : communicator_(communicator),
      neighbours_(std::move(neighbours)),
      n_counted_(n_counted),
      body_node_(std::move(body_node)) {
  const Eigen::ArrayXd counted = Eigen::ArrayXd::Constant(1, double(n_counted_));
  n_in_body_ = static_cast<std::size_t>(sum_over_ranks(communicator_, counted)[0]);
  std::map<std::int32_t, std::map<int, Source>> sources;  // by node, by rank
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    for (std::size_t k = 0; k < neighbours_[n].nodes.size(); ++k)
      sources[neighbours_[n].nodes[k]][neighbours_[n].rank] = {static_cast<std::int32_t>(n),
                                                               static_cast<std::int32_t>(k)};
  const int me = this_rank(communicator_);
  begin_.push_back(0);
  for (auto& [node, of_rank] : sources) {
    of_rank[me] = {};
    common_.push_back(node);
    for (const auto& [rank, source] : of_rank) source_.push_back(source);
    begin_.push_back(source_.size());
  }
}

template <typename T>
std::vector<std::vector<T>> SharedNodes::exchange(const std::vector<std::vector<T>>& sent) const {
  std::vector<std::vector<T>> received(neighbours_.size());
  std::vector<MPI_Request> requests;
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    received[n].resize(sent[n].size());
    for (std::size_t first = 0; first < sent[n].size(); first += values_per_message) {
      const auto bytes = static_cast<int>(sizeof(T) * std::min(values_per_message, sent[n].size() - first));
      MPI_Irecv(&received[n][first], bytes, MPI_BYTE, neighbours_[n].rank, shared_nodes_tag, communicator_,
                &requests.emplace_back());
      MPI_Isend(&sent[n][first], bytes, MPI_BYTE, neighbours_[n].rank, shared_nodes_tag, communicator_,
                &requests.emplace_back());
    }
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return received;
}

template <typename T>
void SharedNodes::sum(const Lanes& lanes, BlockVector<T>& vector) const {
  std::vector<std::vector<T>> sent(neighbours_.size());
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    for (const auto node : neighbours_[n].nodes) append(lanes, vector, node, sent[n]);
  const auto received = exchange(sent);
  const std::size_t per_node = 3 * lanes.n_lanes;
  std::vector<T> own(per_node);
  for (std::size_t i = 0; i < common_.size(); ++i) {
    own.clear();
    append(lanes, vector, common_[i], own);
    std::size_t at = 0;
    for_node(lanes, vector.data(), vector.n_nodes(), common_[i], [&](T* values, std::size_t n) {
      for (auto s = begin_[i]; s < begin_[i + 1]; ++s) {
        const auto& source = source_[s];
        const T* from =
            (source.neighbour < 0 ? own.data() : &received[source.neighbour][source.place * per_node]) + at;
        if (s == begin_[i])
          std::copy(from, from + n, values);
        else
          for (std::size_t l = 0; l < n; ++l) values[l] += from[l];
      }
      at += n;
    });
  }
}

void SharedNodes::sum(std::vector<double>& values, std::size_t per_node) const {
  std::vector<std::vector<double>> sent(neighbours_.size());
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    for (const auto node : neighbours_[n].nodes)
      sent[n].insert(sent[n].end(), &values[node * per_node], &values[node * per_node] + per_node);
  const auto received = exchange(sent);
  for (std::size_t i = 0; i < common_.size(); ++i)
    for (std::size_t l = 0; l < per_node; ++l) {
      double sum = 0;
      for (auto s = begin_[i]; s < begin_[i + 1]; ++s)
        sum += source_[s].neighbour < 0 ? values[common_[i] * per_node + l]
                                        : received[source_[s].neighbour][source_[s].place * per_node + l];
      values[common_[i] * per_node + l] = sum;
    }
}

template <typename T>
void SharedNodes::take_from_owner(const Lanes& lanes, BlockVector<T>& vector) const {
  std::vector<std::vector<T>> sent(neighbours_.size());
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    for (const auto node : neighbours_[n].nodes) append(lanes, vector, node, sent[n]);
  const auto received = exchange(sent);
  const std::size_t per_node = 3 * lanes.n_lanes;
  for (std::size_t i = 0; i < common_.size(); ++i) {
    const auto& owner = source_[begin_[i]];  // the first of the node's ranks
    if (owner.neighbour < 0) continue;
    const T* from = &received[owner.neighbour][owner.place * per_node];
    for_node(lanes, vector.data(), vector.n_nodes(), common_[i], [&](T* values, std::size_t n) {
      std::copy(from, from + n, values);
      from += n;
    });
  }
}

template void SharedNodes::sum(const Lanes&, BlockVector<double>&) const;
template void SharedNodes::sum(const Lanes&, BlockVector<float>&) const;
template void SharedNodes::take_from_owner(const Lanes&, BlockVector<double>&) const;
template void SharedNodes::take_from_owner(const Lanes&, BlockVector<float>&) const;

}  // namespace fem
