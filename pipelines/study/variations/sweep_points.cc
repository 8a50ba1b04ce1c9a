#include "pipelines/study/variations/sweep_points.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "pipelines/base/common/errors.h"

namespace pipelines {
namespace {

constexpr double most_points = 1e6;

void add_point(SweepPlan& plan, const std::vector<std::string>& values, const std::vector<double>& numbers) {
  SweepPoint point{values, numbers, {}};
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] != kept_value)
      for (const auto& key : plan.variations[k].keys()) point.settings.push_back(key + "=" + values[k]);
  plan.points.push_back(std::move(point));
}

double number_at(const Variation& variation, std::size_t i) {
  return variation.numbers.empty() ? std::numeric_limits<double>::quiet_NaN() : variation.numbers[i];
}

void require_count(double n_points) {
  if (n_points > most_points)
    throw OptionError(
        "--vary: these are more than a million points; take fewer values, --design "
        "one-at-a-time, or --design latin-hypercube with --points");
}

void add_grid(SweepPlan& plan) {
  double n_points = 1;
  for (const auto& variation : plan.variations) n_points *= double(variation.values.size());
  require_count(n_points);
  std::vector<std::size_t> at(plan.variations.size(), 0);
  for (std::size_t p = 0; p < std::size_t(n_points); ++p) {
    std::vector<std::string> values;
    std::vector<double> numbers;
    for (std::size_t k = 0; k < at.size(); ++k) {
      values.push_back(plan.variations[k].values[at[k]]);
      numbers.push_back(number_at(plan.variations[k], at[k]));
    }
    add_point(plan, values, numbers);
    for (std::size_t k = at.size(); k-- > 0;) {
      if (++at[k] < plan.variations[k].values.size()) break;
      at[k] = 0;
    }
  }
}

void add_one_at_a_time(SweepPlan& plan) {
  double n_points = 1;
  for (const auto& variation : plan.variations) n_points += double(variation.values.size());
  require_count(n_points);
  const std::size_t n_keys = plan.variations.size();
  const std::vector<std::string> kept(n_keys, kept_value);
  const std::vector<double> none(n_keys, std::numeric_limits<double>::quiet_NaN());
  add_point(plan, kept, none);
  for (std::size_t k = 0; k < n_keys; ++k)
    for (std::size_t i = 0; i < plan.variations[k].values.size(); ++i) {
      auto values = kept;
      auto numbers = none;
      values[k] = plan.variations[k].values[i];
      numbers[k] = number_at(plan.variations[k], i);
      add_point(plan, values, numbers);
    }
}

/// The generator is fixed by the standard, distributions and std::shuffle are not: draws are made of its
/// bits.
class Draws {
public:
  explicit Draws(std::uint64_t seed) : bits_(seed) {}
  /// A random number in [0, 1).
  double share() { return double(bits_() >> 11) * 0x1p-53; }
  std::vector<std::size_t> permutation(std::size_t n) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t(0));
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[std::size_t(share() * double(i))]);
    return order;
  }

private:
  std::mt19937_64 bits_;
};

/// McKay, Beckman and Conover, Technometrics 21 (1979): of n equal shares of each key's range every one holds
/// one point.
void add_latin_hypercube(SweepPlan& plan, std::size_t n_points, std::uint64_t seed) {
  require_count(double(n_points));
  Draws draws(seed);
  std::vector<std::vector<double>> shares;
  for (std::size_t k = 0; k < plan.variations.size(); ++k) {
    shares.emplace_back();
    for (const auto stratum : draws.permutation(n_points))
      shares.back().push_back((double(stratum) + draws.share()) / double(n_points));
  }
  for (std::size_t p = 0; p < n_points; ++p) {
    std::vector<std::string> values;
    std::vector<double> numbers;
    for (std::size_t k = 0; k < plan.variations.size(); ++k) {
      const auto& variation = plan.variations[k];
      if (const auto& range = variation.range) {
        const double number = range->is_logarithmic
                                  ? range->first * std::pow(range->last / range->first, shares[k][p])
                                  : range->first + shares[k][p] * (range->last - range->first);
        values.push_back(variation.text_of(number));
        numbers.push_back(number);
      } else {
        const auto i = std::size_t(shares[k][p] * double(variation.values.size()));
        values.push_back(variation.values[i]);
        numbers.push_back(number_at(variation, i));
      }
    }
    add_point(plan, values, numbers);
  }
}

}  // namespace

std::string to_string(SweepDesign design) {
  return design == SweepDesign::grid            ? "grid"
         : design == SweepDesign::one_at_a_time ? "one-at-a-time"
                                                : "latin-hypercube";
}

SweepPlan plan_sweep(const SweepRequest& request) {
  if (request.vary.empty())
    throw OptionError(
        "--vary: nothing is varied; write --vary \"machine.drive.speed = 1200..1600 rpm / 9\", or vary = "
        "[...] "
        "in [sweep] of the scene");
  SweepPlan plan;
  std::set<std::string> keys;
  for (const auto& text : request.vary) {
    plan.variations.push_back(parse_variation(text));
    const auto& variation = plan.variations.back();
    for (const auto& key : variation.keys())
      if (!keys.insert(key).second)
        throw OptionError("--vary " + text + ": the key is varied already; give all its values at once");
    if (variation.values.empty() && request.design != SweepDesign::latin_hypercube)
      throw OptionError("--vary " + text +
                        ": how many values? Write A..B UNIT / 9, or take --design latin-hypercube");
  }
  switch (request.design) {
    case SweepDesign::grid:
      add_grid(plan);
      break;
    case SweepDesign::one_at_a_time:
      add_one_at_a_time(plan);
      break;
    case SweepDesign::latin_hypercube:
      if (request.n_points < 2)
        throw OptionError("--design latin-hypercube: how many points? Add --points, 2 at least");
      add_latin_hypercube(plan, std::size_t(request.n_points), request.seed);
  }
  return plan;
}

}  // namespace pipelines
