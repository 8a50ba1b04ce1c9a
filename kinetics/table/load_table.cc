#include "kinetics/table/load_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "kinetics/table/periodic_cubic.h"
#include "kinetics/values/constants.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double turn_rad = 2 * pi;
constexpr double worth_a_warning = 0.01;
constexpr double missed_worth_a_warning = 0.03;
constexpr double too_much_missed = 0.1;  // below, samples_passed_over tells what is missed
constexpr double worth_telling = 0.001;

std::string name_of(const TableLoad& load) {
  return load.port + "." + load.component;
}

void check_samples(const std::string& name, const SampledCourse& samples, double period_rad) {
  const Index n = samples.angle_rad.size();
  if (n < 4)
    throw MachineRefused(name + " has " + std::to_string(n) + " samples; give at least four over the period");
  if (samples.values.size() != n)
    throw MachineRefused(name + " has " + std::to_string(n) + " angles and " +
                         std::to_string(samples.values.size()) + " values; give one for each");
  for (Index i = 0; i < n; ++i) {
    require_finite(name + " at sample " + std::to_string(i + 1), samples.values[i]);
    require_finite(name + ".angle at sample " + std::to_string(i + 1), samples.angle_rad[i]);
    if (i > 0 && samples.angle_rad[i] <= samples.angle_rad[i - 1])
      refuse(name + ".angle at sample " + std::to_string(i + 1), samples.angle_rad[i],
             "does not ascend: the sample before is at " + number(samples.angle_rad[i - 1]) +
                 "; sort the samples and remove repetitions");
  }
  const double span_rad = samples.angle_rad[n - 1] - samples.angle_rad[0];
  if (span_rad > period_rad * (1 + 1e-9))
    refuse(name + ".angle span", span_rad,
           "exceeds the period of " + number(period_rad / turn_rad) +
               " turns; raise the number of turns, or cut the samples");
  const ArrayXd steps = samples.angle_rad.tail(n - 1) - samples.angle_rad.head(n - 1);
  // Samples on both sides of a gap say that the file goes on there; where the period closes nothing does.
  constexpr double most_within = 2.0 / 3;
  const double closing_rad = period_rad - span_rad, within_rad = steps.maxCoeff();
  if (closing_rad > turn_rad / 2 * (1 + 1e-9))
    refuse(name + " gap in the angle", closing_rad,
           "leaves more than half a turn without a sample; the samples must cover the period of " +
               number(period_rad / turn_rad) + " turns");
  if (within_rad > turn_rad * most_within)
    refuse(name + " gap in the angle", within_rad,
           "leaves more than two thirds of a turn without a sample between two of them; give more samples");
}

void check_harmonic(const std::string& name, const HarmonicCourse& harmonic, const TimeGrid& grid) {
  require_finite(name + ".mean", harmonic.mean);
  require_finite(name + ".amplitude", harmonic.amplitude);
  require_finite(name + ".phase", harmonic.phase_rad);
  require_finite(name + ".order", harmonic.order);
  const double periods = harmonic.order * grid.turns;
  if (harmonic.order < 0 || std::abs(periods - std::round(periods)) > 1e-9 * std::max(1.0, periods))
    refuse(name + ".order", harmonic.order,
           "must not be negative, and a whole number of its periods must fit the " +
               std::to_string(grid.turns) + " turns; change one of the two");
  if (harmonic.amplitude != 0 && 2 * harmonic.order >= grid.instants_per_turn)
    refuse(name + ".order", harmonic.order,
           "has " + std::to_string(grid.instants_per_turn) +
               " instants per turn, not more than two per period: they cannot tell it from a slower "
               "harmonic or a constant; take more than " +
               number(2 * harmonic.order) + " instants per turn");
}

void check_effects(const std::vector<std::string>& effects, const LoadTable& table) {
  std::vector<std::string> known;
  for (const auto& effect : load_table_effects(table)) known.push_back(effect.name);
  for (const auto& effect : effects)
    if (std::find(known.begin(), known.end(), effect) == known.end())
      throw MachineRefused("effect \"" + effect + "\" is unknown; did you mean \"" + nearest(effect, known) +
                           "\"? The table has: " + listed(known));
}

void check(const LoadTable& table, const TimeGrid& grid) {
  require_finite("speed_rad_s", table.speed_rad_s);
  if (table.speed_rad_s <= 0)
    refuse("speed_rad_s", table.speed_rad_s, "must be positive: it ties time and angle together");
  check_grid(grid);
  if (table.loads.empty()) throw MachineRefused("the load table is empty; give at least one load");
  for (std::size_t i = 0; i < table.loads.size(); ++i) {
    const TableLoad& load = table.loads[i];
    for (std::size_t j = 0; j < i; ++j)
      if (table.loads[j].effect == load.effect && name_of(table.loads[j]) == name_of(load))
        throw MachineRefused(name_of(load) + " is given twice for the effect \"" + load.effect +
                             "\"; remove one, or name another effect for it");
    if (const auto* samples = std::get_if<SampledCourse>(&load.course))
      check_samples(name_of(load), *samples, grid.turns * turn_rad);
    else
      check_harmonic(name_of(load), std::get<HarmonicCourse>(load.course), grid);
  }
}

/// A last sample that stands where the next period begins gives way to the first.
Index n_of_period(const SampledCourse& samples, double period_rad) {
  const Index n = samples.angle_rad.size();
  return samples.angle_rad[n - 1] - samples.angle_rad[0] > period_rad * (1 - 1e-9) ? n - 1 : n;
}

/// Samples over one period as a curve.
table::PeriodicCubic curve_of(const SampledCourse& samples, double period_rad) {
  const Index n = n_of_period(samples, period_rad);
  return {samples.angle_rad.head(n), samples.values.head(n), period_rad};
}

ArrayXd evaluate(const TableLoad& load, const ArrayXd& phi_rad, double period_rad) {
  if (const auto* harmonic = std::get_if<HarmonicCourse>(&load.course))
    return harmonic->mean + harmonic->amplitude * (harmonic->order * phi_rad - harmonic->phase_rad).cos();
  const auto curve = curve_of(std::get<SampledCourse>(load.course), period_rad);
  return phi_rad.unaryExpr([&](double phi) { return curve(phi); });
}

ResamplingError error_of(const TableLoad& load, const SampledCourse& samples, double period_rad) {
  const Index n = samples.angle_rad.size();
  ResamplingError error{load.effect, load.port, load.component};
  error.largest = samples.values.abs().maxCoeff();
  const bool closes = samples.angle_rad[n - 1] - samples.angle_rad[0] > period_rad * (1 - 1e-9);
  const double usual =
      closes ? 0 : (samples.values.tail(n - 1) - samples.values.head(n - 1)).abs().maxCoeff();
  error.jump = std::max(0.0, std::abs(samples.values[n - 1] - samples.values[0]) - usual);
  SampledCourse every_second;
  const Index n_half = (n - (closes ? 1 : 0) + 1) / 2;
  every_second.angle_rad.resize(n_half);
  every_second.values.resize(n_half);
  for (Index i = 0; i < n_half; ++i) {
    every_second.angle_rad[i] = samples.angle_rad[2 * i];
    every_second.values[i] = samples.values[2 * i];
  }
  const auto coarse = curve_of(every_second, period_rad);
  for (Index i = 1; i < n; i += 2)
    error.between = std::max(error.between, std::abs(coarse(samples.angle_rad[i]) - samples.values[i]));
  return error;
}

void warn(const ResamplingError& error, LoadHistory& history) {
  const std::string name = error.effect + "/" + error.port + "." + error.component;
  const auto percent = [&](double part) {
    return number(std::round(1000 * part / error.largest) / 10) + " %";
  };
  if (error.jump > worth_a_warning * error.largest)
    history.warnings.push_back(name + " jumps by " + percent(error.jump) +
                               " of its largest value where the period closes: check the number of turns");
  if (error.between > worth_a_warning * error.largest)
    history.warnings.push_back(name + " changes by up to " + percent(error.between) +
                               " of its largest value between every second sample: interpolation adds up to "
                               "that much where the samples are that coarse");
}

std::string in_degrees(double angle_rad) {
  return number(std::round(1800 / pi * angle_rad) / 10);
}

/// A part of the period without samples amid others that are close together: a logger that lost some. What
/// every second sample tells of interpolation does not hold there.
void warn_of_gap_within(const TableLoad& load, const SampledCourse& samples, LoadHistory& history) {
  constexpr double unusual = 5, worth_a_word_rad = pi / 12;
  const Index n = samples.angle_rad.size();
  ArrayXd steps = samples.angle_rad.tail(n - 1) - samples.angle_rad.head(n - 1);
  Index widest = 0;
  const double gap_rad = steps.maxCoeff(&widest);
  std::nth_element(steps.begin(), steps.begin() + (n - 1) / 2, steps.end());
  const double usual_rad = steps[(n - 1) / 2];
  const bool is_much = gap_rad > turn_rad / 2 * (1 + 1e-9);
  if (!is_much && (gap_rad <= unusual * usual_rad * (1 + 1e-9) || gap_rad < worth_a_word_rad)) return;
  history.warnings.push_back(load.effect + "/" + name_of(load) + " has no sample over " +
                             in_degrees(gap_rad) + " degrees from " + in_degrees(samples.angle_rad[widest]) +
                             " degrees on, and elsewhere one every " + in_degrees(usual_rad) +
                             " degrees most often: what lies there is drawn from one end to the other; check "
                             "the file");
}

/// Samples that end well before the next period begins: another speed, another number of turns, or a file cut
/// short.
void warn_of_gap(const TableLoad& load, const SampledCourse& samples, double period_rad,
                 LoadHistory& history) {
  constexpr double unusual = 2;
  const Index n = samples.angle_rad.size();
  const double usual_rad = (samples.angle_rad.tail(n - 1) - samples.angle_rad.head(n - 1)).maxCoeff();
  const double gap_rad = period_rad - (samples.angle_rad[n - 1] - samples.angle_rad[0]);
  if (gap_rad <= unusual * usual_rad) return;
  history.warnings.push_back(
      load.effect + "/" + name_of(load) + " has no sample over " + in_degrees(gap_rad) +
      " degrees where its period closes, and elsewhere one every " + in_degrees(usual_rad) +
      " degrees at least: what lies there is drawn from one end to the other; check "
      "speed, number of turns and "
      "the end of the file");
}

/// Where the instants lie further apart than the samples, they may miss the largest or the smallest one:
/// nothing in their values tells.
void check_missed(const TableLoad& load, const SampledCourse& samples, const ArrayXd& values,
                  const TimeGrid& grid, LoadHistory& history) {
  const ArrayXd given = samples.values.head(n_of_period(samples, grid.turns * turn_rad));
  const double largest = given.abs().maxCoeff();
  const double above = given.maxCoeff() - values.maxCoeff(), below = values.minCoeff() - given.minCoeff();
  const double missed = std::max(above, below);
  if (missed <= missed_worth_a_warning * largest) return;
  const Index n = samples.angle_rad.size();
  const double step_rad = (samples.angle_rad.tail(n - 1) - samples.angle_rad.head(n - 1)).minCoeff();
  const std::string sentence =
      load.effect + "/" + name_of(load) + " is " + number(std::round(1000 * missed / largest) / 10) + " % " +
      (above >= below ? "larger" : "smaller") + " between the instants than at them, " +
      std::to_string(grid.instants_per_turn) + " per turn; the closest samples correspond to " +
      number(std::ceil(turn_rad / step_rad * (1 - 1e-9))) +
      " per turn: set sampling.instants_per_turn to at least that";
  if (missed > too_much_missed * largest) throw MachineRefused(sentence);
  history.warnings.push_back(sentence);
}

/// Few instants in a period of a harmonic may miss its crest or its trough.
void warn_of_missed(const TableLoad& load, const HarmonicCourse& harmonic, const ArrayXd& values,
                    const TimeGrid& grid, LoadHistory& history) {
  const double size = std::abs(harmonic.amplitude), largest = std::abs(harmonic.mean) + size;
  if (harmonic.order == 0) return;
  const double above = harmonic.mean + size - values.maxCoeff(),
               below = values.minCoeff() - (harmonic.mean - size);
  const double missed = std::max(above, below);
  if (missed <= missed_worth_a_warning * largest) return;
  history.warnings.push_back(
      load.effect + "/" + name_of(load) + " is " + number(std::round(1000 * missed / largest) / 10) + " % " +
      (above >= below ? "larger" : "smaller") + " between the instants than at them, which are " +
      number(std::round(10 * grid.instants_per_turn / harmonic.order) / 10) + " in a period of order " +
      number(harmonic.order) + ": raise sampling.instants_per_turn");
}

struct AroundAnAngle {
  double before, after;  ///< values at the instants around it
  double part;           ///< share of the way from the instant before to the one after
};

/// @param values  at the instants of a period
AroundAnAngle around(double angle_rad, const ArrayXd& values, const TimeGrid& grid) {
  const double at = angle_rad / turn_rad * grid.instants_per_turn, before = std::floor(at);
  const auto value = [&](double instant) {
    const double periods = std::floor(instant / double(values.size()));
    return values[std::min(values.size() - 1, Index(instant - periods * double(values.size())))];
  };
  return {value(before), value(before + 1), at - before};
}

/// Distance of each sample from the straight line between the instants around it, in shares of the largest.
/// @param values  at the instants
ArrayXd shares_off_the_line(const SampledCourse& samples, const ArrayXd& values, const TimeGrid& grid) {
  const Index n = n_of_period(samples, grid.turns * turn_rad);
  const double largest = samples.values.head(n).abs().maxCoeff();
  ArrayXd share = ArrayXd::Zero(n);
  if (!(largest > 0)) return share;
  for (Index i = 0; i < n; ++i) {
    const auto [before, after, part] = around(samples.angle_rad[i], values, grid);
    share[i] = std::abs(samples.values[i] - (before + part * (after - before))) / largest;
  }
  return share;
}

/// Most that a sample between two instants exceeds both of their values, or falls short of them, as a share
/// of the largest sample. A jump does neither.
double share_beyond_instants(const SampledCourse& samples, const ArrayXd& values, const TimeGrid& grid) {
  const Index n = n_of_period(samples, grid.turns * turn_rad);
  const double largest = samples.values.head(n).abs().maxCoeff();
  double most = 0;
  for (Index i = 0; i < n; ++i) {
    const auto [before, after, part] = around(samples.angle_rad[i], values, grid);
    most = std::max(
        {most, samples.values[i] - std::max(before, after), std::min(before, after) - samples.values[i]});
  }
  return largest > 0 ? most / largest : 0;
}

/// Adds a load of the history's last effect.
void post(const TableLoad& load, const ArrayXd& values, LoadHistory& history) {
  const std::vector<std::string> planar{"fx", "fy", "torque"};
  const auto row = std::find(planar.begin(), planar.end(), load.component) - planar.begin();
  if (row == 3) {
    const std::string name = name_of(load);
    auto quantity = std::find_if(history.quantities.begin(), history.quantities.end(),
                                 [&](const auto& q) { return q.name == name; });
    if (quantity == history.quantities.end())
      history.quantities.push_back({name, load.unit, "from the load table", values});
    else
      quantity->values += values;
    return;
  }
  if (!history.has_resultant(load.port))
    history.resultants.push_back(
        {load.port, "from the load table, at that port", Eigen::Array3Xd::Zero(3, values.size()), {}});
  auto& resultant = *std::find_if(history.resultants.begin(), history.resultants.end(),
                                  [&](const auto& r) { return r.role == load.port; });
  auto& parts = resultant.contributions;
  const std::size_t effect = history.effects.size() - 1;
  if (parts.empty() || parts.back().effect != effect)
    parts.push_back({effect, Eigen::Array3Xd::Zero(3, values.size())});
  parts.back().load.row(row) = values.transpose();
  resultant.total.row(row) += values.transpose();
}

}  // namespace

std::vector<EffectInfo> load_table_effects(const LoadTable& table) {
  std::vector<EffectInfo> effects;
  for (const auto& load : table.loads) {
    const auto known = std::find_if(effects.begin(), effects.end(),
                                    [&](const EffectInfo& e) { return e.name == load.effect; });
    if (known == effects.end())
      effects.push_back({load.effect, "loads of the table: " + name_of(load), "the user's"});
    else
      known->description += ", " + name_of(load);
  }
  return effects;
}

std::vector<ResamplingError> resampling_errors(const LoadTable& table, const TimeGrid& grid) {
  check(table, grid);
  std::vector<ResamplingError> errors;
  for (const auto& load : table.loads)
    if (const auto* samples = std::get_if<SampledCourse>(&load.course))
      errors.push_back(error_of(load, *samples, grid.turns * turn_rad));
  return errors;
}

namespace {

void check(const LoadTable& table, const std::vector<std::string>& effects, const TimeGrid& grid) {
  check(table, grid);
  check_effects(effects, table);
}

ArrayXd instants_of(const TimeGrid& grid) {
  const Index n = Index(grid.turns) * grid.instants_per_turn;
  return ArrayXd::LinSpaced(n, 0, n - 1) * (turn_rad / grid.instants_per_turn);
}

/// Evaluates each load of the effects at the angles.
template <typename Take>
void evaluate_all(const LoadTable& table, const std::vector<std::string>& effects, const TimeGrid& grid,
                  const ArrayXd& phi_rad, const Take& take) {
  for (const auto& effect : load_table_effects(table)) {
    if (std::find(effects.begin(), effects.end(), effect.name) == effects.end()) continue;
    for (const auto& load : table.loads)
      if (load.effect == effect.name) take(load, evaluate(load, phi_rad, grid.turns * turn_rad));
  }
}

}  // namespace

ArrayXd samples_passed_over(const LoadTable& table, const std::vector<std::string>& effects,
                            const TimeGrid& grid, Index most) {
  check(table, effects, grid);
  std::vector<std::pair<double, double>> found;  // share, angle
  evaluate_all(table, effects, grid, instants_of(grid), [&](const TableLoad& load, const ArrayXd& values) {
    const auto* samples = std::get_if<SampledCourse>(&load.course);
    if (samples == nullptr) return;
    const ArrayXd share = shares_off_the_line(*samples, values, grid);
    for (Index i = 0; i < share.size(); ++i)
      if (share[i] > worth_telling) found.emplace_back(share[i], samples->angle_rad[i]);
  });
  if (Index(found.size()) > most) {
    std::nth_element(found.begin(), found.begin() + most, found.end(), std::greater<>());
    found.resize(std::size_t(most));
  }
  std::vector<double> angle_rad;
  for (const auto& [share, angle] : found) angle_rad.push_back(angle);
  std::sort(angle_rad.begin(), angle_rad.end());
  angle_rad.erase(std::unique(angle_rad.begin(), angle_rad.end()), angle_rad.end());
  return Eigen::Map<const ArrayXd>(angle_rad.data(), Index(angle_rad.size()));
}

ArrayXd course_of_rough_samples(const LoadTable& table, const std::vector<std::string>& effects,
                                const TimeGrid& grid, Index most) {
  constexpr double rough = 0.2, wanted = 16, least = 4;
  check(table, effects, grid);
  bool is_rough = false;
  double step_rad = turn_rad / grid.instants_per_turn;
  evaluate_all(table, effects, grid, instants_of(grid), [&](const TableLoad& load, const ArrayXd& values) {
    const auto* samples = std::get_if<SampledCourse>(&load.course);
    if (samples == nullptr) return;
    const Index n = values.size(), n_samples = samples->angle_rad.size();
    const double closing = std::abs(values[0] - values[n - 1]),
                 change = std::max(closing, (values.tail(n - 1) - values.head(n - 1)).abs().maxCoeff());
    if (!(change > rough * values.abs().maxCoeff())) return;
    is_rough = true;
    step_rad = std::min(
        step_rad,
        (samples->angle_rad.tail(n_samples - 1) - samples->angle_rad.head(n_samples - 1)).minCoeff());
  });
  if (!is_rough) return {};
  const double per_instant = turn_rad / grid.instants_per_turn / step_rad * (1 - 1e-9),
               room = std::floor(double(most) / (double(grid.turns) * grid.instants_per_turn));
  if (std::ceil(least * per_instant) > room) return {};
  const double times = std::min(std::ceil(wanted * per_instant), room);
  return instants_of({grid.turns, int(times) * grid.instants_per_turn});
}

std::vector<std::string> warnings_of_cycles(const LoadTable& table, const std::vector<std::string>& effects,
                                            const TimeGrid& grid) {
  constexpr double much = 0.2;
  check(table, effects, grid);
  std::vector<std::string> warnings;
  evaluate_all(table, effects, grid, instants_of(grid), [&](const TableLoad& load, const ArrayXd& values) {
    const auto* samples = std::get_if<SampledCourse>(&load.course);
    const double share = samples != nullptr ? share_beyond_instants(*samples, values, grid) : 0;
    if (share > much)
      warnings.push_back(
          load.effect + "/" + name_of(load) + ": samples between two instants, " +
          std::to_string(grid.instants_per_turn) + " per turn, are beyond both by up to " +
          number(std::round(100 * share)) +
          " % of the largest: lives count the cycles at the instants, and may be many times too "
          "long; raise sampling.instants_per_turn");
  });
  return warnings;
}

LoadHistory loads_at(const LoadTable& table, const std::vector<std::string>& effects, const TimeGrid& grid,
                     const ArrayXd& phi_rad) {
  check(table, effects, grid);
  const Index n = phi_rad.size();
  LoadHistory history;
  history.machine = "load_table";
  history.convention = "given";
  history.phi_rad = phi_rad;
  history.time_s = phi_rad / table.speed_rad_s;
  history.speed_rad_s = ArrayXd::Constant(n, table.speed_rad_s);
  history.acceleration_rad_s2 = ArrayXd::Zero(n);
  evaluate_all(table, effects, grid, phi_rad, [&](const TableLoad& load, const ArrayXd& values) {
    if (history.effects.empty() || history.effects.back() != load.effect)
      history.effects.push_back(load.effect);
    post(load, values, history);
  });
  return history;
}

LoadHistory compute_loads(const LoadTable& table, const std::vector<std::string>& effects,
                          const TimeGrid& grid) {
  auto history = loads_at(table, effects, grid, instants_of(grid));
  evaluate_all(table, effects, grid, history.phi_rad, [&](const TableLoad& load, const ArrayXd& values) {
    if (const auto* harmonic = std::get_if<HarmonicCourse>(&load.course))
      return warn_of_missed(load, *harmonic, values, grid, history);
    const auto& samples = std::get<SampledCourse>(load.course);
    warn(error_of(load, samples, grid.turns * turn_rad), history);
    warn_of_gap(load, samples, grid.turns * turn_rad, history);
    warn_of_gap_within(load, samples, history);
    check_missed(load, samples, values, grid, history);
  });
  return history;
}

}  // namespace kinetics
