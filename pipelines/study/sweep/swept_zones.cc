#include "pipelines/study/sweep/swept_zones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {
namespace {

double distance_between(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bool boxes_meet(const SweptZone& a, const SweptZone& b) {
  for (std::size_t c = 0; c < 3; ++c)
    if (a.low_m[c] > b.high_m[c] || b.low_m[c] > a.high_m[c]) return false;
  return true;
}

/// Keys of all points: numbers as shares of their range, other values as their place among them.
std::vector<std::vector<double>> shares_of_keys(const SweepPlan& plan) {
  std::vector<std::vector<double>> shares(plan.points.size());
  for (std::size_t k = 0; k < plan.variations.size(); ++k) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const auto& point : plan.points)
      if (!std::isnan(point.numbers[k])) {
        low = std::min(low, point.numbers[k]);
        high = std::max(high, point.numbers[k]);
      }
    std::map<std::string, double> others;  // a value that is no number is as far from every other as a range
    for (std::size_t p = 0; p < plan.points.size(); ++p) {
      const double number = plan.points[p].numbers[k];
      shares[p].push_back(
          !std::isnan(number)
              ? (high > low ? (number - low) / (high - low) : 0)
              : 2 + double(others.emplace(plan.points[p].values[k], double(others.size())).first->second));
    }
  }
  return shares;
}

/// The earlier point with zones that is nearest; of equally near ones the latest.
std::optional<std::size_t> nearest_before(std::size_t p, const std::vector<std::vector<double>>& shares,
                                          const std::vector<SweepRow>& rows) {
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::max();
  for (std::size_t q = p; q-- > 0;) {
    if (rows[q].zones.empty()) continue;
    double squares = 0;
    for (std::size_t k = 0; k < shares[p].size(); ++k)
      squares += (shares[p][k] - shares[q][k]) * (shares[p][k] - shares[q][k]);
    if (squares < least) {
      least = squares;
      nearest = q;
    }
  }
  return nearest;
}

struct Pair {
  std::size_t zone, number;
  double distance_m;
};

/// Gives zones that have no number yet that of a known zone that they meet, nearest peaks first.
/// @param known  by number less 1; null: no candidate
void take_numbers(const std::vector<SweptZone>& zones, const std::vector<const SweptZone*>& known,
                  std::vector<int>& numbers) {
  std::vector<Pair> pairs;
  for (std::size_t z = 0; z < zones.size(); ++z) {
    if (numbers[z] != 0) continue;
    for (std::size_t n = 0; n < known.size(); ++n)
      if (known[n] != nullptr && known[n]->body == zones[z].body && boxes_meet(zones[z], *known[n]) &&
          std::find(numbers.begin(), numbers.end(), int(n) + 1) == numbers.end())
        pairs.push_back({z, n, distance_between(zones[z].peak_m, known[n]->peak_m)});
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.distance_m < b.distance_m; });
  for (const auto& pair : pairs)
    if (numbers[pair.zone] == 0 &&
        std::find(numbers.begin(), numbers.end(), int(pair.number) + 1) == numbers.end())
      numbers[pair.zone] = int(pair.number) + 1;
}

/// Numbers anew from 1 within each body, the largest peak of all points first.
void number_by_peak(const std::vector<SweepRow>& rows, std::vector<std::vector<int>>& numbers,
                    std::size_t n_numbers) {
  std::vector<double> largest_Pa(n_numbers, 0.0);
  std::vector<std::string> body(n_numbers);
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (std::size_t z = 0; z < rows[p].zones.size(); ++z) {
      const auto n = std::size_t(numbers[p][z] - 1);
      largest_Pa[n] = std::max(largest_Pa[n], rows[p].zones[z].peak_Pa);
      body[n] = rows[p].zones[z].body;
    }
  std::vector<std::size_t> order(n_numbers);
  for (std::size_t n = 0; n < n_numbers; ++n) order[n] = n;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return largest_Pa[a] > largest_Pa[b]; });
  std::map<std::string, int> given;
  std::vector<int> renamed(n_numbers);
  for (const auto n : order) renamed[n] = ++given[body[n]];
  for (auto& of_point : numbers)
    for (auto& number : of_point) number = renamed[std::size_t(number - 1)];
}

}  // namespace

std::vector<SweptZone> swept_zones(const Judged& analysis) {
  std::vector<SweptZone> result;
  for (const auto& zone : analysis.zones.zones) {
    SweptZone swept{figures_of(analysis, zone), analysis.scene.name, {}, {}, zone.instant};
    swept.low_m.fill(std::numeric_limits<double>::max());
    swept.high_m.fill(std::numeric_limits<double>::lowest());
    result.push_back(std::move(swept));
  }
  const auto& of_node = analysis.zones.zone_of_node;
  for (std::size_t i = 0; i < of_node.size(); ++i) {
    if (of_node[i] == 0) continue;
    auto& zone = result[std::size_t(of_node[i] - 1)];
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = analysis.responses.nodes.xyz_m[3 * i + c];
      zone.low_m[c] = std::min(zone.low_m[c], x);
      zone.high_m[c] = std::max(zone.high_m[c], x);
    }
  }
  return result;
}

std::vector<std::vector<int>> follow_zones(const SweepPlan& plan, const std::vector<SweepRow>& rows) {
  std::vector<std::vector<int>> numbers(rows.size());
  if (std::all_of(rows.begin(), rows.end(), [](const SweepRow& row) { return row.zones.empty(); }))
    return numbers;  // below, each point looks at all before it
  const auto shares = shares_of_keys(plan);
  std::vector<const SweptZone*> latest;  // by number less 1
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const auto& zones = rows[p].zones;
    numbers[p].assign(zones.size(), 0);
    if (const auto before = nearest_before(p, shares, rows)) {
      std::vector<const SweptZone*> there(latest.size(), nullptr);
      for (std::size_t z = 0; z < rows[*before].zones.size(); ++z)
        there[std::size_t(numbers[*before][z] - 1)] = &rows[*before].zones[z];
      take_numbers(zones, there, numbers[p]);
      take_numbers(zones, latest, numbers[p]);
    }
    for (std::size_t z = 0; z < zones.size(); ++z) {
      if (numbers[p][z] == 0) {
        latest.push_back(nullptr);
        numbers[p][z] = int(latest.size());
      }
      latest[std::size_t(numbers[p][z] - 1)] = &zones[z];
    }
  }
  number_by_peak(rows, numbers, latest.size());
  return numbers;
}

void add_zone_figures(std::vector<SweepRow>& rows, const std::vector<std::vector<int>>& numbers) {
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (std::size_t z = 0; z < rows[p].zones.size(); ++z) {
      const auto& zone = rows[p].zones[z];
      const auto name = "bodies." + zone.body + ".zones[" + std::to_string(numbers[p][z]) + "]";
      rows[p].figures.add({name, ".peak"}, "Pa", zone.peak_Pa);
      rows[p].figures.add({name, ".peak.error"}, "Pa", zone.error_Pa);
      rows[p].figures.add({name, ".volume"}, "m3", zone.volume_m3);
    }
}

}  // namespace pipelines
