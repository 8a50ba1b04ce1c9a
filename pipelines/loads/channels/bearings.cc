#include "pipelines/loads/channels/bearings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

/// Values of a channel "<port>.<component>"; empty if there is none.
std::optional<Eigen::ArrayXd> channel(const ChannelHistory& channels, const std::string& name) {
  for (std::size_t k = 0; k < channels.channels.size(); ++k)
    if (channels.channels[k].name == name) return channels.values.row(Eigen::Index(k)).transpose();
  return std::nullopt;
}

double speed_of(const BearingScene& bearing, const kinetics::LoadHistory& loads) {
  if (bearing.speed_rad_s) return *bearing.speed_rad_s;
  for (const auto& quantity : loads.quantities)
    if (quantity.name == "drum_relative_speed") return quantity.values.abs().mean();
  return loads.speed_rad_s.abs().mean();
}

/// Turns of the drive from instant to instant, up to a factor: in a run-up the load counts by its turns.
Eigen::ArrayXd turns_of(const kinetics::LoadHistory& loads) {
  const Eigen::Index n = loads.n_instants();
  const auto& speed = loads.speed_rad_s;
  if (n < 2 || speed.maxCoeff() == speed.minCoeff()) return Eigen::ArrayXd::Ones(n);
  const Eigen::ArrayXd step = loads.phi_rad.tail(n - 1) - loads.phi_rad.head(n - 1);
  Eigen::ArrayXd turns = Eigen::ArrayXd::Zero(n);
  turns.head(n - 1) += step / 2;
  turns.tail(n - 1) += step / 2;
  return turns;
}

BearingAnswers answers_of(const BearingScene& bearing, const BearingResult& result) {
  BearingAnswers answers;
  const double load_N = result.equivalent_load_N;
  if (bearing.static_rating_N && result.largest_load_N > 0)
    answers.static_safety = *bearing.static_rating_N / result.largest_load_N;
  if (!result.life) return answers;
  const double share = bearing.reliability.value_or(0.9);
  const double a1 = kinetics::life_factor(share);
  const double a_iso = bearing.lubrication
                           ? kinetics::life_modification_factor(*bearing.lubrication, load_N, bearing.element)
                           : 1;
  if (bearing.reliability) answers.a1 = a1;
  if (bearing.lubrication) answers.a_iso = a_iso;
  if (answers.a1 || answers.a_iso) answers.modified_life_h = a1 * a_iso * result.life->hours;
  if (answers.a1 || answers.a_iso || bearing.required_life_s) answers.reliability = share;
  if (!bearing.required_life_s) return answers;
  const double hours = *bearing.required_life_s / 3600, exponent = kinetics::life_exponent(bearing.element);
  const double millions = kinetics::required_million_revolutions(hours, result.speed_rad_s);
  kinetics::WeibullLife law;
  law.life_exponent = exponent;
  answers.required_life_h = hours;
  answers.required_rating_N = load_N * std::pow(millions / (a1 * a_iso), 1 / exponent);
  answers.weibull_rating_N = kinetics::required_rating_N(load_N, millions, share, law);
  answers.weibull_reliability = kinetics::reliability(load_N, millions, bearing.dynamic_rating_N, law);
  return answers;
}

}  // namespace

std::optional<Eigen::ArrayXd> force_of(const std::string& load, const kinetics::LoadHistory& loads,
                                       const std::vector<const ChannelHistory*>& channels) {
  for (const auto* body : channels) {
    const auto fx = channel(*body, load + ".fx"), fy = channel(*body, load + ".fy");
    if (fx && fy) return (fx->square() + fy->square()).sqrt();
    if (fx || fy) return (fx ? *fx : *fy).abs();  // the other one is never fed
  }
  return force_of(load, loads);
}

std::vector<std::string> answer_lines(const BearingAnswers& answers) {
  std::vector<std::string> lines;
  if (answers.modified_life_h) {
    std::string factors;
    if (answers.a1) factors += fmt::format("a1 {:.3g}", *answers.a1);
    if (answers.a_iso) factors += fmt::format("{}a_ISO {:.3g}", factors.empty() ? "" : ", ", *answers.a_iso);
    lines.push_back(fmt::format("{:.5g} % of them reach {:.5g} h ({}; ISO 281)", 100 * *answers.reliability,
                                *answers.modified_life_h, factors));
  }
  if (answers.required_rating_N) {
    lines.push_back(fmt::format(
        "{:.5g} h with {:.5g} % need a dynamic rating of {:.5g} N (ISO 281) or {:.5g} N (Weibull, Shigley)",
        *answers.required_life_h, 100 * *answers.reliability, *answers.required_rating_N,
        *answers.weibull_rating_N));
    lines.push_back(fmt::format("{:.5g} % of them reach {:.5g} h (Weibull, Shigley)",
                                100 * *answers.weibull_reliability, *answers.required_life_h));
  }
  if (answers.static_safety)
    lines.push_back(fmt::format("static safety {:.3g}, by the largest load", *answers.static_safety));
  return lines;
}

std::vector<BearingResult> bearing_lives(const std::vector<BearingScene>& bearings,
                                         const kinetics::LoadHistory& loads,
                                         const std::vector<const ChannelHistory*>& channels) {
  std::vector<BearingResult> results;
  for (const auto& bearing : bearings) {
    const auto force = force_of(bearing.load, loads, channels);
    if (!force)
      throw StageRefused("bearing \"" + bearing.name + "\": there is no force \"" + bearing.load +
                         "\"; known here: " + listed(known_forces(loads)) +
                         (channels.empty() ? ", and with `run` the ports of the bodies" : ""));
    BearingResult result;
    result.name = bearing.name;
    result.load = bearing.load;
    const Eigen::ArrayXd part = bearing.share * *force;
    result.largest_load_N = part.maxCoeff();
    result.equivalent_load_N = kinetics::equivalent_load_N(part, turns_of(loads), bearing.element);
    result.speed_rad_s = speed_of(bearing, loads);
    result.life = kinetics::rating_life(bearing.dynamic_rating_N, result.equivalent_load_N, bearing.element,
                                        result.speed_rad_s);
    result.answers = answers_of(bearing, result);
    results.push_back(std::move(result));
  }
  return results;
}

void warn_beyond_ratings(const std::vector<BearingScene>& bearings, const std::vector<BearingResult>& results,
                         kinetics::LoadHistory& loads) {
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].equivalent_load_N > 0.5 * bearings[i].dynamic_rating_N)
      loads.warnings.push_back(fmt::format(
          "bearing \"{}\": its equivalent load of {:.4g} N is more than half of its dynamic rating "
          "of {:.4g} N, where the life law of ISO 281 ends: take a larger bearing or ask its "
          "maker, and check the rating's unit",
          results[i].name, results[i].equivalent_load_N, bearings[i].dynamic_rating_N));
}

std::vector<std::string> forces_along_bearings(const std::vector<BearingResult>& results,
                                               const std::vector<const ChannelHistory*>& channels) {
  // The least e of ISO 281, table 3, deep groove ball bearings: below F_a / F_r = e it is P = F_r.
  constexpr double least_e = 0.19;
  std::vector<std::string> sentences;
  for (const auto& bearing : results)
    for (const auto* body : channels) {
      const auto along = channel(*body, bearing.load + ".fz");
      if (!along || along->abs().maxCoeff() <= least_e * bearing.equivalent_load_N) continue;
      sentences.push_back(
          fmt::format("bearing \"{}\": the force along the shaft at {}, up to {:.4g} N, is not in its load "
                      "of {:.4g} N; its "
                      "life is that of the load across the shaft alone, and ISO 281 has factors for both",
                      bearing.name, bearing.load, along->abs().maxCoeff(), bearing.equivalent_load_N));
    }
  return sentences;
}

}  // namespace pipelines
