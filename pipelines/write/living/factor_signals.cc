#include "pipelines/write/living/factor_signals.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

constexpr double law_tolerance = 1e-6;

/// |F| cos(n arg F), or of the sine.
Eigen::ArrayXd turning(const ArrayXXd& force, int harmonic, bool is_sine) {
  Eigen::ArrayXd values(force.cols());
  for (Index t = 0; t < force.cols(); ++t) {
    const double size = std::hypot(force(0, t), force(1, t));
    const double angle = harmonic * std::atan2(force(1, t), force(0, t));
    values[t] = size * (is_sine ? std::sin(angle) : std::cos(angle));
  }
  return values;
}

/// The port of "<port>.p4c".
std::string port_of_pressure(const std::string& channel) {
  return channel.substr(0, channel.rfind(".p"));
}

std::optional<PressureLaw> law_of(const BodyLoads& loads, std::size_t k) {
  const auto* pressure = std::get_if<fem::SeatPressure>(&loads.unit_loads[k].shape);
  if (pressure == nullptr) return std::nullopt;
  const auto force = loads.pressing_force_N.find(port_of_pressure(loads.history.channels[k].name));
  if (force == loads.pressing_force_N.end()) return std::nullopt;
  PressureLaw law;
  law.channel = Index(k);
  law.harmonic = pressure->harmonic;
  law.is_sine = pressure->phase == fem::SeatPressure::Phase::sine;
  const auto course = turning(force->second, law.harmonic, law.is_sine);
  const Eigen::ArrayXd values = loads.history.values.row(law.channel).transpose();
  const double square = course.square().sum();
  if (square == 0) return std::nullopt;
  law.factor = (course * values).sum() / square;
  if ((values - law.factor * course).abs().maxCoeff() > law_tolerance * values.abs().maxCoeff())
    return std::nullopt;
  return law;
}

std::optional<Index> place_of(const ChannelHistory& history, const std::string& channel) {
  for (std::size_t k = 0; k < history.channels.size(); ++k)
    if (history.channels[k].name == channel) return Index(k);
  return std::nullopt;
}

}  // namespace

ArrayXXd FactorSignals::factors(const ArrayXXd& signals) const {
  ArrayXXd factors = ArrayXXd::Zero(n_channels, signals.cols());
  for (std::size_t i = 0; i < channels.size(); ++i) factors.row(channels[i]) = signals.row(Index(i));
  for (const auto& law : laws)
    factors.row(law.channel) =
        law.factor * turning(signals.middleRows(law.force, 2), law.harmonic, law.is_sine).transpose();
  return factors;
}

FactorSignals factor_signals(const BodyLoads& loads) {
  FactorSignals signals;
  signals.n_channels = Index(loads.history.channels.size());
  for (std::size_t k = 0; k < loads.history.channels.size(); ++k) {
    const auto law = law_of(loads, k);
    if (!law) {
      signals.channels.push_back(Index(k));
      continue;
    }
    signals.laws.push_back(*law);
    const auto port = port_of_pressure(loads.history.channels[k].name);
    if (std::find(signals.forces.begin(), signals.forces.end(), port) == signals.forces.end())
      signals.forces.push_back(port);
  }
  for (auto& law : signals.laws) {
    const auto port = port_of_pressure(loads.history.channels[std::size_t(law.channel)].name);
    const auto at = std::find(signals.forces.begin(), signals.forces.end(), port) - signals.forces.begin();
    law.force = Index(signals.channels.size()) + 2 * at;
  }
  return signals;
}

ArrayXXd signals_of(const FactorSignals& signals, const BodyLoads& of, const BodyLoads& loads,
                    std::string& trouble) {
  ArrayXXd values = ArrayXXd::Zero(signals.size(), loads.history.values.cols());
  const auto& channels = of.history.channels;
  for (std::size_t i = 0; i < signals.channels.size(); ++i)
    if (const auto k = place_of(loads.history, channels[std::size_t(signals.channels[i])].name))
      values.row(Index(i)) = loads.history.values.row(*k);
  for (std::size_t i = 0; i < signals.forces.size(); ++i)
    if (const auto force = loads.pressing_force_N.find(signals.forces[i]);
        force != loads.pressing_force_N.end())
      values.middleRows(Index(signals.channels.size() + 2 * i), 2) = force->second;
  const auto factors = signals.factors(values);
  for (std::size_t k = 0; k < loads.history.channels.size(); ++k) {
    const auto& name = loads.history.channels[k].name;
    const auto own = place_of(of.history, name);
    const auto wanted = loads.history.values.row(Index(k));
    if (!own)
      trouble = "it brings a load that this run has not solved (" + name + ")";
    else if ((factors.row(*own) - wanted).abs().maxCoeff() > 1e3 * law_tolerance * wanted.abs().maxCoeff())
      trouble = "the pressure at " + port_of_pressure(name) + " would spread otherwise";
  }
  return values;
}

}  // namespace pipelines
