#include "pipelines/write/pictures/load_charts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kinetics/series/harmonics.h"
#include "kinetics/series/load_spectrum.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/write/drawing/chart.h"

namespace pipelines {
namespace {

constexpr std::size_t most_resultants = 6;
constexpr double rpm = 30 / pi;

Eigen::ArrayXd force_of(const kinetics::Resultant& resultant) {
  return resultant.total.topRows<2>().matrix().colwise().norm().transpose().array();
}

/// Resultants with a force, the largest first.
std::vector<const kinetics::Resultant*> largest_resultants(const kinetics::LoadHistory& loads) {
  std::vector<const kinetics::Resultant*> all;
  for (const auto& resultant : loads.resultants)
    if (resultant.total.cols() > 0 && force_of(resultant).maxCoeff() > 0) all.push_back(&resultant);
  std::stable_sort(all.begin(), all.end(), [](const auto* a, const auto* b) {
    return force_of(*a).maxCoeff() > force_of(*b).maxCoeff();
  });
  all.resize(std::min(all.size(), most_resultants));
  return all;
}

std::string name_of(const kinetics::Resultant& resultant) {
  auto name = resultant.role;
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::vector<double> vector_of(const Eigen::ArrayXd& values) {
  return {values.data(), values.data() + values.size()};
}

/// Writes charts and remembers their files.
class Charts {
public:
  explicit Charts(std::filesystem::path directory) : directory_(std::move(directory)) {}

  template <typename Chart>
  void write(const Chart& chart, const std::string& name) {
    if (!write_chart(chart, directory_ / name)) return;
    files.push_back(name + ".png");
    files.push_back(name + ".svg");
  }

  std::vector<std::string> files;

private:
  std::filesystem::path directory_;
};

/// Of several turns the one with the largest force: all of them would be a comb.
/// @param turns  0: a run-up, shown whole
LineChart histories(const std::string& title, const kinetics::LoadHistory& loads,
                    const std::vector<const kinetics::Resultant*>& resultants, int turns) {
  Eigen::Index first = 0, n = loads.phi_rad.size();
  std::string which = "loads over the drive's angle";
  if (turns > 1) {
    n /= turns;
    Eigen::Index at = 0;
    force_of(*resultants.front()).maxCoeff(&at);
    first = at / n * n;
    which = fmt::format("loads over turn {} of {}, which has the largest", first / n + 1, turns);
  }
  LineChart chart{title + ": " + which, {"angle of the drive [deg]", false}, {"force [N]", false}, {}};
  const auto angle_deg = vector_of((loads.phi_rad.segment(first, n) - loads.phi_rad[first]) * (180 / pi));
  for (const auto* resultant : resultants)
    add_or_join(
        chart.curves,
        {name_of(*resultant), angle_deg, vector_of(force_of(*resultant).segment(first, n)), {}, true});
  return chart;
}

LineChart polar(const std::string& title, const std::vector<const kinetics::Resultant*>& resultants) {
  LineChart chart{
      title + ": paths of the forces", {"force along x [N]", false}, {"force along y [N]", false}, {}};
  chart.has_equal_scales = true;
  for (const auto* resultant : resultants)
    chart.curves.push_back({name_of(*resultant),
                            vector_of(resultant->total.row(0).transpose()),
                            vector_of(resultant->total.row(1).transpose()),
                            {},
                            true});
  return chart;
}

/// Root of the sum of both components' squared amplitudes.
LineChart harmonics(const std::string& title, const std::vector<const kinetics::Resultant*>& resultants,
                    int turns) {
  constexpr int most_order = 8;
  LineChart chart{title + ": harmonics of the forces",
                  {"order of the drive's speed", false},
                  {"amplitude [N]", false},
                  {}};
  chart.is_from_zero = true;
  for (const auto* resultant : resultants) {
    ChartCurve curve{name_of(*resultant), {}, {}, {}, false};
    curve.has_stems = true;
    std::map<double, double> squares;
    for (const int c : {0, 1}) {
      const Eigen::ArrayXd component = resultant->total.row(c).transpose();
      const int n_lines = std::min<int>(most_order * turns, int(component.size() / 2));
      for (const auto& line : kinetics::line_spectrum(component, turns, n_lines).lines)
        squares[line.order] += line.amplitude * line.amplitude;
    }
    double largest = 0;
    for (const auto& entry : squares) largest = std::max(largest, entry.second);
    for (const auto& [order, square] : squares)
      if (square > 1e-6 * largest) {
        curve.x.push_back(order);
        curve.y.push_back(std::sqrt(square));
      }
    if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
  }
  return chart;
}

/// Cycles of a force's size: mean along x, range along y.
HeatMap rainflow(const std::string& title, const kinetics::Resultant& resultant, bool repeats) {
  constexpr std::size_t n = 16;
  const Eigen::ArrayXd force = force_of(resultant);
  const auto cycles =
      kinetics::spectrum(repeats ? kinetics::rainflow_repeating(force) : kinetics::rainflow(force));
  const double least = force.minCoeff(), most = force.maxCoeff(), width = std::max(most - least, 1e-300);
  HeatMap map;
  map.title = title + ": rainflow cycles of " + name_of(resultant) + ", by size of the force";
  map.x_title = "mean [N]";
  map.y_title = "range [N]";
  map.figure_title = "cycles";
  map.figures.assign(n * n, std::nan(""));
  const auto bin = [](double share) {
    return std::size_t(std::clamp(share * double(n), 0.0, double(n) - 1));
  };
  for (const auto& cycle : cycles) {
    double& count = map.figures[bin(cycle.range / width) * n + bin((cycle.mean - least) / width)];
    count = (std::isnan(count) ? 0 : count) + cycle.count;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double share = (double(i) + 0.5) / double(n);
    map.x_values.push_back(fmt::format("{:.4g}", least + share * width));
    map.y_values.push_back(fmt::format("{:.4g}", share * width));
  }
  return map;
}

}  // namespace

std::vector<std::string> write_load_charts(const std::filesystem::path& directory, const std::string& title,
                                           const kinetics::LoadHistory& loads, int turns) {
  Charts charts(directory);
  const auto resultants = largest_resultants(loads);
  if (resultants.empty()) return {};
  charts.write(histories(title, loads, resultants, turns), "histories");
  charts.write(polar(title, resultants), "polar");
  if (turns > 0) charts.write(harmonics(title, resultants, turns), "harmonics");
  charts.write(rainflow(title, *resultants.front(), turns > 0), "rainflow");
  return charts.files;
}

std::vector<std::string> write_torsion_charts(const std::filesystem::path& directory, const Scene& scene,
                                              const TorsionReport& report) {
  Charts charts(directory);
  const auto& table = report.campbell;
  const auto speed_rpm = vector_of(table.speed_rad_s * rpm);
  LineChart campbell{scene.title + ": Campbell diagram",
                     {"speed of the reference shaft [rpm]", false},
                     {"frequency [Hz]", false},
                     {}};
  for (std::size_t l = 0; l < table.lines.size(); ++l) {
    const auto& line = table.lines[l];
    const auto name =
        line.order > 0
            ? fmt::format("{}order {:g}", line.excitation.empty() ? "" : line.excitation + ", ", line.order)
            : line.excitation;
    const Eigen::ArrayXd frequency_Hz =
        table.line_frequency_rad_s.row(Eigen::Index(l)).transpose() / (2 * pi);
    add_or_join(campbell.curves, {name, speed_rpm, vector_of(frequency_Hz), {}, true});
  }
  // Modes far above all excitations would press these to the axis.
  const double highest_rad_s =
      table.line_frequency_rad_s.size() > 0 ? table.line_frequency_rad_s.maxCoeff() : 0;
  for (Eigen::Index m = 0; m < table.natural_frequency_rad_s.size(); ++m) {
    const double w = table.natural_frequency_rad_s[m];
    if (m > 0 && w > 3 * highest_rad_s) continue;
    campbell.curves.push_back({fmt::format("mode {}", m + 1),
                               speed_rpm,
                               std::vector<double>(speed_rpm.size(), w / (2 * pi)),
                               {},
                               true});
  }
  if (!campbell.curves.empty()) charts.write(campbell, "campbell");
  const auto& modes = report.modes;
  std::vector<std::string> names_of_inertias;
  for (const auto& inertia : std::get<kinetics::DriveTrain>(scene.machine).inertias)
    names_of_inertias.push_back(inertia.name);
  LineChart shapes{scene.title + ": modes, reduced angles of unit length",
                   {"inertia", false, names_of_inertias},
                   {"reduced angle", false},
                   {}};
  for (Eigen::Index m = 0; m < std::min<Eigen::Index>(6, modes.reduced_shape.cols()); ++m) {
    ChartCurve curve{fmt::format("{:.5g} Hz", modes.frequency_rad_s[m] / (2 * pi)), {}, {}, {}, true};
    for (Eigen::Index i = 0; i < modes.reduced_shape.rows(); ++i) {
      curve.x.push_back(double(i) + 1);
      curve.y.push_back(modes.reduced_shape(i, m));
    }
    shapes.curves.push_back(std::move(curve));
  }
  if (!shapes.curves.empty()) charts.write(shapes, "modes");
  return charts.files;
}

std::vector<std::string> write_whirl_chart(const std::filesystem::path& directory, const std::string& title,
                                           const CriticalSpeeds& speeds) {
  LineChart chart{title + ": whirl of the shaft", {"speed [rpm]", false}, {"frequency [Hz]", false}, {}};
  double highest_Hz = 0;
  const auto add = [&](const std::string& name, const auto& frequency_rad_s) {
    ChartCurve curve{name, {}, {}, {}, true, false};
    for (std::size_t i = 0; i < speeds.campbell_rad_s.size(); ++i) {
      curve.x.push_back(speeds.campbell_rad_s[i] * rpm);
      curve.y.push_back(frequency_rad_s(i) / (2 * pi));
    }
    highest_Hz = std::max(highest_Hz, curve.y.back());
    add_or_join(chart.curves, std::move(curve));
  };
  for (const auto& [name, list] : {std::pair("forward", &fem::WhirlFrequencies::forward_rad_s),
                                   {"backward", &fem::WhirlFrequencies::backward_rad_s}})
    for (std::size_t mode = 0; mode < (speeds.campbell_whirl.front().*list).size(); ++mode)
      add(fmt::format("{} {}", name, mode + 1),
          [&, of = list](std::size_t i) { return (speeds.campbell_whirl[i].*of)[mode]; });
  // Orders that would leave the picture would press the whirl to its floor.
  const double highest_rad_s = 2 * pi * highest_Hz;
  for (const auto& load : speeds.loads) {
    const double order = std::abs(load.order);
    if (order * speeds.campbell_rad_s.back() <= 1.5 * highest_rad_s)
      add(load_name(load.order), [&](std::size_t i) { return order * speeds.campbell_rad_s[i]; });
  }
  Charts charts(directory);
  charts.write(chart, "campbell");
  return charts.files;
}

}  // namespace pipelines
