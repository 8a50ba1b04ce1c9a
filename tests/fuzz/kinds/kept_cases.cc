/// What is kept between runs: unit responses, what is known of the iteration, and the machine's costs.
#include <cmath>
#include <nlohmann/json.hpp>

#include "pipelines/accuracy/cost_calibration.h"
#include "pipelines/files/content_hash.h"
#include "pipelines/files/json_file.h"
#include "pipelines/responses/iteration_memory.h"
#include "pipelines/responses/response_files.h"
#include "tests/fuzz/kinds/samples.h"
#include "tests/fuzz/verdicts.h"

namespace fuzz {
namespace {

/// A file with a checksum is believed if nothing has been changed in it, and only then.
/// @param believed  takes what is to be told to the user
Verdict kept_judged(const std::string& name, bool changed,
                    const std::function<bool(const pipelines::Tell&)>& believed) {
  std::string told;
  bool accepted = false;
  auto verdict = judged(name, [&] {
    accepted = believed([&](const std::string& line) { told += line; });
    if (!told.empty() && told.find(name) == std::string::npos) return "no file is named: " + told;
    return std::string(accepted == changed ? "a changed file is believed, or a sound one is not" : "");
  });
  verdict.accepted = accepted;
  return verdict;
}

using Costs = nlohmann::ordered_json;

/// The same with a checksum that fits, as another version or another program would write it.
void sign_costs(const std::filesystem::path& file) {
  auto json = pipelines::read_json_file(file);
  if (!json.is_object()) return;
  json.erase("checksum");
  json["checksum"] = pipelines::text_hash(json.dump(-1, ' ', false, Costs::error_handler_t::replace));
  write_bytes(file, json.dump(-1, ' ', false, Costs::error_handler_t::replace));
}

std::string fault_of_costs(const pipelines::CostCalibration& costs) {
  for (const double factor : {costs.direct, costs.iterative, costs.superposition})
    if (!std::isfinite(factor) || !(factor > 0)) return "a factor is not finite and positive";
  return costs.n_runs < 0 ? "a negative number of runs" : "";
}

}  // namespace

Verdict responses_case(Mutator& random, const Place& place) {
  if (random.one_in(10)) {
    const auto& sound = place.samples.gave_up;
    const auto text = random.damage(sound, Grammar::bytes, sound);
    write_bytes(place / "iteration_gave_up.txt", text);
    return kept_judged("iteration_gave_up.txt", text != sound, [&](const pipelines::Tell& tell) {
      return pipelines::iteration_gave_up_before(place.directory, kept_key, tell);
    });
  }
  const auto& sound = place.samples.responses;
  const auto bytes = random.damage(sound, Grammar::bytes, sound);
  write_bytes(place / "unit_responses.h5", bytes);
  return kept_judged("unit_responses.h5", bytes != sound, [&](const pipelines::Tell& tell) {
    return pipelines::read_unit_responses(place / "unit_responses.h5", kept_key, tell).has_value();
  });
}

Verdict costs_case(Mutator& random, const Place& place) {
  const auto& sound = random.one_of(place.samples.costs);
  const auto file = place / "costs.json";
  write_bytes(file, random.damage(sound, Grammar::json, random.one_of(place.samples.costs)));
  if (random.one_in(2)) sign_costs(file);
  bool believed = false;
  auto verdict = judged("costs.json", [&] {
    const auto costs = pipelines::read_calibration(file);
    believed = costs.fault.empty();
    if (!believed && costs.fault.find("costs.json") == std::string::npos)
      return "no file is named: " + costs.fault;
    if (auto fault = fault_of_costs(costs); !fault.empty()) return fault;
    pipelines::learn_cost(file, fem::Solver::direct, 1.5, 2);
    const auto learnt = pipelines::read_calibration(file);
    if (!learnt.fault.empty()) return "what is learnt cannot be read: " + learnt.fault;
    return fault_of_costs(learnt);
  });
  verdict.accepted = verdict.accepted && believed;
  return verdict;
}

}  // namespace fuzz
