#include "pipelines/study/sweep/points_on_ranks.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "pipelines/study/sweep/sweep_journal.h"

namespace pipelines {
namespace {

/// A message begins with the number of points, or this.
constexpr std::size_t end_of_rows = std::size_t(-1);
constexpr int rows_tag = 11;

void append(std::vector<char>& bytes, const void* from, std::size_t n) {
  const auto* first = static_cast<const char*>(from);
  bytes.insert(bytes.end(), first, first + n);
}

/// Reads numbers from the beginning of a message on.
class Reader {
public:
  explicit Reader(const std::vector<char>& bytes) : bytes_(bytes) {}
  std::size_t number() {
    std::size_t n = 0;
    std::memcpy(&n, bytes_.data() + at_, sizeof n);
    at_ += sizeof n;
    return n;
  }
  std::string rest() const { return {bytes_.begin() + std::ptrdiff_t(at_), bytes_.end()}; }

private:
  const std::vector<char>& bytes_;
  std::size_t at_ = 0;
};

void rest_a_little() {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

std::vector<int> deal_points(const std::vector<std::size_t>& group, int n_ranks) {
  std::vector<int> rank;
  for (const auto own : group) rank.push_back(int(own % std::size_t(n_ranks)));
  return rank;
}

void RowsToFirstRank::send(std::vector<char> bytes) {
  if (bytes.size() > std::size_t(std::numeric_limits<int>::max()))
    throw std::length_error("rows of " + std::to_string(bytes.size()) +
                            " bytes are more than one message to rank 0 takes: sweep fewer points at once");
  auto& sent = sent_.emplace_back(Sent{std::move(bytes), MPI_REQUEST_NULL});
  MPI_Isend(sent.bytes.data(), int(sent.bytes.size()), MPI_BYTE, 0, rows_tag, MPI_COMM_WORLD, &sent.request);
}

void RowsToFirstRank::send(const std::vector<std::size_t>& points, const std::vector<SweepRow>& rows) {
  const std::size_t n = points.size();
  const auto lines = SweepJournal::lines_of(plan_, points, rows);
  std::vector<char> bytes;
  append(bytes, &n, sizeof n);
  append(bytes, points.data(), sizeof(std::size_t) * n);
  append(bytes, lines.data(), lines.size());
  send(std::move(bytes));
}

void RowsToFirstRank::end(std::size_t n_improved_meshes) {
  std::vector<char> bytes;
  append(bytes, &end_of_rows, sizeof end_of_rows);
  append(bytes, &n_improved_meshes, sizeof n_improved_meshes);
  send(std::move(bytes));
  for (auto& sent : sent_) {
    int has_left = 0;
    while (MPI_Test(&sent.request, &has_left, MPI_STATUS_IGNORE), has_left == 0) rest_a_little();
  }
  sent_.clear();
}

void RowsOfOtherRanks::take(std::vector<SweepRow>& rows, const SweepListener& listener) {
  while (n_open_ > 0) {
    int is_there = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, rows_tag, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return;
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::vector<char> bytes(static_cast<std::size_t>(size));
    MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, rows_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    Reader message(bytes);
    const auto n = message.number();
    if (n == end_of_rows) {
      n_improved_ += message.number();
      --n_open_;
      continue;
    }
    std::vector<std::size_t> points(n);
    for (auto& point : points) point = message.number();
    SweepPlan part;
    for (const auto p : points) part.points.push_back(plan_.points[p]);
    auto received = SweepJournal::rows_of(message.rest(), part);
    for (std::size_t i = 0; i < n; ++i) rows[points[i]] = std::move(received[i].value());
    points_.insert(points_.end(), points.begin(), points.end());
    listener(points, rows);
  }
}

void RowsOfOtherRanks::take_all(std::vector<SweepRow>& rows, const SweepListener& listener) {
  for (take(rows, listener); n_open_ > 0; take(rows, listener)) rest_a_little();
}

}  // namespace pipelines
