#include "pipelines/accuracy/cost_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "pipelines/common/errors.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/files/content_hash.h"
#include "pipelines/files/json_file.h"
#include "pipelines/files/kept_file.h"

namespace pipelines {
namespace {

/// Superposition on two threads: of one product of channel and unit stress; what the measures of stress take
/// at an instant, and a node's bookkeeping, in such products. AMD EPYC of 2023 with AVX-512, 2026-11-21, from
/// the times of `tests/benchmarks/run --benchmark_filter=superposition`; the solvers' constants are in
/// fem/values/cost_constants.h.
constexpr double s_per_product = 1.5e-10, products_per_instant = 12, products_per_node = 7000;

using Json = nlohmann::ordered_json;

/// More are not counted.
constexpr std::uint64_t most_runs = 1'000'000'000;

const char* const checksum_key = "checksum";

/// Of the other keys in their order.
std::string checksum_of(const Json& json) {
  return text_hash(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

CostCalibration calibration_of(const Json& json) {
  const auto factor = [&](const char* key) {
    const auto found = json.find(key);
    const double value = found != json.end() && found->is_number() ? found->get<double>() : 1.0;
    return value > 0 && std::isfinite(value) ? value : 1.0;
  };
  CostCalibration kept;
  kept.direct = factor("direct");
  kept.iterative = factor("iterative");
  kept.superposition = factor("superposition");
  if (const auto runs = json.find("runs"); runs != json.end() && runs->is_number_unsigned())
    kept.n_runs = int(std::min(runs->get<std::uint64_t>(), most_runs));
  return kept;
}

void move_half(double& factor, double measured) {
  if (measured > 0 && std::isfinite(measured)) factor = std::sqrt(factor * measured);
}

}  // namespace

std::filesystem::path calibration_file() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
    return std::filesystem::path(cache) / "millstress/costs.json";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".cache/millstress/costs.json";
  return {};
}

CostCalibration read_calibration(const std::filesystem::path& file) {
  std::error_code none_there;
  if (file.empty() || !std::filesystem::exists(file, none_there)) return {};
  auto json = read_json_file(file);
  if (json.is_object() && json.contains(checksum_key)) {
    const Json checksum = json[checksum_key];
    json.erase(checksum_key);
    if (checksum == checksum_of(json)) return calibration_of(json);
  }
  CostCalibration none;
  none.fault = damaged_file_text(file);
  return none;
}

void learn_cost(const std::filesystem::path& file, fem::Solver solver, double solve_ratio,
                double superposition_ratio) {
  if (file.empty()) return;
  auto kept = read_calibration(file);
  move_half(solver == fem::Solver::iterative ? kept.iterative : kept.direct, solve_ratio);
  move_half(kept.superposition, superposition_ratio);
  Json json{{"direct", kept.direct},
            {"iterative", kept.iterative},
            {"superposition", kept.superposition},
            {"runs", kept.n_runs + 1}};
  json[checksum_key] = checksum_of(json);
  try {
    write_text_file(file, json.dump(2) + "\n");
  } catch (const FileError&) {  // a run need not be able to remember
  } catch (const OptionError&) {
  } catch (const std::filesystem::filesystem_error&) {
  }
}

double predicted_superposition_s(std::size_t n_nodes, std::size_t n_instants, std::size_t n_channels) {
  return s_per_product * double(n_nodes) *
         (double(n_instants) * (double(n_channels) + products_per_instant) + products_per_node);
}

}  // namespace pipelines
