/// What is kept between runs: unit responses.
#include "pipelines/respond/responses/response_files.h"
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

}  // namespace

Verdict responses_case(Mutator& random, const Place& place) {
  const auto& sound = place.samples.responses;
  const auto bytes = random.damage(sound, Grammar::bytes, sound);
  write_bytes(place / "unit_responses.h5", bytes);
  return kept_judged("unit_responses.h5", bytes != sound, [&](const pipelines::Tell& tell) {
    return pipelines::read_unit_responses(place / "unit_responses.h5", kept_key, tell).has_value();
  });
}

}  // namespace fuzz
