#include "kinetics/vibratory/spring_choice.h"

#include <algorithm>
#include <cmath>

#include "kinetics/vibratory/pitch.h"
#include "kinetics/vibratory_effects/affine_optimum.h"
#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {
namespace {

Eigen::Array2Xd reaction_to(const std::vector<NamedEffect>& effects, const Instants& at) {
  Eigen::Array2Xd reaction_N = Eigen::Array2Xd::Zero(2, at.size());
  for (const NamedEffect& effect : effects)
    for (const PlacedForce& placed : effect.evaluate(at)) reaction_N -= placed.force_N;
  return reaction_N;
}

Instants all_instants(const VibratoryMill& mill, const TimeGrid& grid) {
  return steady_instants(mill, grid, 0, Eigen::Index(grid.turns) * grid.instants_per_turn);
}

/// Golden section in the logarithm of the scale; the objective has one minimum between the ends.
double refined(const std::function<double(double)>& objective, double low, double high) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = std::log(low), b = std::log(high);
  double x = b - golden * (b - a), y = a + golden * (b - a);
  double fx = objective(std::exp(x)), fy = objective(std::exp(y));
  while (b - a > 1e-9) {  // a smooth minimum shows no more: the objective is flat to 1e-18 there
    if (fx <= fy) {
      b = y, y = x, fy = fx, x = b - golden * (b - a), fx = objective(std::exp(x));
    } else {
      a = x, x = y, fx = fy, y = a + golden * (b - a), fy = objective(std::exp(y));
    }
  }
  return std::exp(fx <= fy ? x : y);
}

}  // namespace

VibratoryMill ScalableMill::scaled_by(double scale) const {
  VibratoryMill scaled = mill;
  for (Spring& spring : scaled.springs) spring.stiffness_N_m *= scale;
  return scaled;
}

Eigen::Array2Xd ScalableMill::reaction_N(double scale) const {
  const VibratoryMill scaled = scaled_by(scale);
  const auto made = make_effects(scaled, effects);
  Instants at = all_instants(scaled, grid);
  if (contains(effects, "pitch")) solve_pitch(scaled, made).apply(at);
  return reaction_to(made, at);
}

double ScalableMill::transmitted_N(double scale) const {
  const VibratoryMill scaled = scaled_by(scale);
  const auto made = make_effects(scaled, effects);
  Instants at = all_instants(scaled, grid);
  if (contains(effects, "pitch")) solve_pitch(scaled, made).apply(at);
  std::vector<NamedEffect> of_springs;
  for (const NamedEffect& effect : made)
    if (effect.name == "springs" || effect.name == "spring_damping") of_springs.push_back(effect);
  Eigen::Array2Xd force_N = reaction_to(of_springs, at);
  force_N.colwise() -= force_N.rowwise().mean().eval();
  return peak_norm(force_N);
}

Eigen::Array2Xd ScalableMill::slope_N() const {
  VibratoryMill elastic = mill;
  for (Spring& spring : elastic.springs) spring.preload_N = Eigen::Vector2d::Zero();
  return reaction_to(make_effects(elastic, {"springs"}), all_instants(elastic, grid));
}

std::vector<PitchResonance> pitch_resonances(const ScalableMill& scalable, const SpringSearch& search) {
  const auto made = make_effects(scalable.mill, scalable.effects);
  const PitchOscillator chamber = pitch_oscillator(scalable.mill, made);
  double given_N_m = 0;
  for (const Spring& spring : scalable.mill.springs) given_N_m += spring.stiffness_N_m.y();
  std::vector<PitchResonance> resonances;
  if (chamber.stiffness_Nm == 0) return resonances;
  for (const MomentHarmonic& forcing : moment_harmonics(scalable.mill, made)) {
    const double w = std::abs(forcing.frequency_rad_s);
    const double scale = chamber.inertia_kg_m2 * w * w / chamber.stiffness_Nm;
    const bool is_known = std::any_of(resonances.begin(), resonances.end(), [&](const PitchResonance& other) {
      // A charge that keeps step with the drive brings the same line twice.
      return std::abs(other.frequency_rad_s - w) <= 1e-9 * w;
    });
    if (!is_known && scale >= search.least_scale && scale <= search.most_scale)
      resonances.push_back({scale, scale * given_N_m, w, forcing.p, forcing.q, false});
  }
  std::sort(resonances.begin(), resonances.end(),
            [](const PitchResonance& a, const PitchResonance& b) { return a.scale < b.scale; });
  return resonances;
}

double scan_for_least(const std::function<double(double)>& objective, const SpringSearch& search) {
  const int n = search.n_scan;
  const double ratio = std::log(search.most_scale / search.least_scale);
  std::vector<double> scale, value;
  for (int i = 0; i < n; ++i) {
    scale.push_back(i == n - 1 ? search.most_scale : search.least_scale * std::exp(ratio * i / (n - 1)));
    value.push_back(objective(scale.back()));
  }
  double best = scale[0], least = value[0];
  const auto offer = [&](double candidate, double found) {
    if (found < least) best = candidate, least = found;
  };
  for (int i = 0; i < n; ++i) {
    const int before = std::max(i - 1, 0), after = std::min(i + 1, n - 1);
    if (!std::isfinite(value[std::size_t(i)])) continue;
    offer(scale[std::size_t(i)], value[std::size_t(i)]);
    if (value[std::size_t(i)] > value[std::size_t(before)] ||
        value[std::size_t(i)] > value[std::size_t(after)])
      continue;
    const double found = refined(objective, scale[std::size_t(before)], scale[std::size_t(after)]);
    offer(found, objective(found));
  }
  return best;
}

}  // namespace kinetics::vibratory
