#include "fem/mesh/ranks/row_exchange.h"

#include <algorithm>
#include <utility>

#include "fem/mesh/ranks/ranks.h"

namespace fem {

namespace {

constexpr int row_tag = 5, list_tag = 6;
constexpr std::size_t values_per_message = std::size_t(1) << 27;  // MPI counts in 31 bits

/// Sends a list to each rank and receives one from each, in pieces.
/// @param received  as long as they will be
template <typename T>
void exchange(MPI_Comm communicator, int tag, MPI_Datatype type, const std::vector<std::vector<T>>& sent,
              std::vector<std::vector<T>>& received) {
  std::vector<MPI_Request> requests;
  for (std::size_t r = 0; r < sent.size(); ++r) {
    for (std::size_t at = 0; at < received[r].size(); at += values_per_message)
      MPI_Irecv(&received[r][at], int(std::min(values_per_message, received[r].size() - at)), type, int(r),
                tag, communicator, &requests.emplace_back());
    for (std::size_t at = 0; at < sent[r].size(); at += values_per_message)
      MPI_Isend(&sent[r][at], int(std::min(values_per_message, sent[r].size() - at)), type, int(r), tag,
                communicator, &requests.emplace_back());
  }
  MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

}  // namespace

RowExchange::RowExchange(const SharedRows& shared, std::vector<std::int32_t> wanted)
    : shared_(shared), wanted_(std::move(wanted)) {
  const auto n = std::size_t(n_ranks(shared.communicator));
  from_.resize(n);
  to_.resize(n);
  std::vector<std::vector<std::int32_t>> asked(n);
  for (std::size_t i = 0; i < wanted_.size(); ++i)
    if (const auto node = std::size_t(wanted_[i]); shared.row[node] < 0) {
      const auto owner = std::size_t(shared.rank_of_node[node]);
      from_[owner].push_back(std::int32_t(i));
      asked[owner].push_back(wanted_[i]);
    }
  std::vector<int> n_asked(n), n_given(n);
  for (std::size_t r = 0; r < n; ++r) n_asked[r] = int(asked[r].size());
  MPI_Alltoall(n_asked.data(), 1, MPI_INT, n_given.data(), 1, MPI_INT, shared.communicator);
  for (std::size_t r = 0; r < n; ++r) to_[r].resize(std::size_t(n_given[r]));
  exchange(shared.communicator, list_tag, MPI_INT32_T, asked, to_);
  for (auto& nodes : to_)
    for (auto& node : nodes) node = shared.row[std::size_t(node)];
}

RowExchange::Rows RowExchange::operator()(const Eigen::Ref<const Rows>& own) const {
  const auto width = std::size_t(own.cols());
  std::vector<std::vector<double>> sent(to_.size()), received(from_.size());
  for (std::size_t r = 0; r < to_.size(); ++r) {
    sent[r].reserve(to_[r].size() * width);
    for (const auto row : to_[r])
      sent[r].insert(sent[r].end(), own.row(row).data(), own.row(row).data() + width);
    received[r].resize(from_[r].size() * width);
  }
  exchange(shared_.communicator, row_tag, MPI_DOUBLE, sent, received);
  sent.clear();
  Rows rows(Eigen::Index(wanted_.size()), own.cols());
  for (std::size_t i = 0; i < wanted_.size(); ++i)
    if (const auto row = shared_.row[std::size_t(wanted_[i])]; row >= 0)
      rows.row(Eigen::Index(i)) = own.row(row);
  for (std::size_t r = 0; r < from_.size(); ++r)
    for (std::size_t k = 0; k < from_[r].size(); ++k)
      std::copy_n(&received[r][k * width], width, rows.row(from_[r][k]).data());
  return rows;
}

}  // namespace fem
