#include "pipelines/judge/analysis/crest_elsewhere.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "pipelines/judge/analysis/stress_under_changed_loads.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/superpose/between_instants/cycle_extremes.h"
#include "pipelines/superpose/between_instants/factor_spectrum.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {
namespace {

using Eigen::Index;

constexpr Index per_period = 24, least_to_close = 16;
constexpr double least_line = 0.01;  // of the largest channel of its unit

/// Re sum_h c_h exp(2 pi j h i / n) at i = 0 .. n - 1.
Eigen::ArrayXd series_of(const Eigen::ArrayXXcd& lines, Index n) {
  Eigen::FFT<double> transform;
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(n), series(n);
  spectrum.head(lines.cols()) = lines.row(0).matrix().transpose() * double(n);
  transform.inv(series, spectrum);
  return series.real().array();
}

/// @param at_instants_Pa  largest stress at the point at an instant
/// @param largest_Pa      that of the point with the errors
void add_crest(const StressPoint& point, double at_instants_Pa, double largest_Pa, const Responded& analysis,
               ErrorBudget& errors) {
  const auto unit = unit_stress_at(analysis.responses, point);
  const double excess_Pa = at_instants_Pa + sampling_error_Pa(unit, analysis.loads.history) - largest_Pa;
  if (excess_Pa > errors.of("time_sampling"))
    errors.set_numerical({"time_sampling", "crest between the instants at another point", excess_Pa, 1});
}

void add_crest_at_node(const ChannelHistory& denser, int n_threads, Judged& analysis) {
  const auto crests = envelope(denser, analysis.responses, n_threads);
  const auto node = peak_node(crests.von_mises.value_Pa, analysis.places);
  auto& peak = analysis.peak;
  if (node != peak.node)
    add_crest({{{node, 1.0}}, 0}, analysis.envelope.von_mises.value_Pa[node], peak.value_Pa, analysis,
              peak.errors);
}

void add_crest_at_toe(const ChannelHistory& denser, Judged& analysis) {
  const auto& spots = analysis.hot_spots;
  if (spots.empty()) return;
  std::vector<double> crest_Pa;
  for (const auto& spot : spots)
    crest_Pa.push_back(largest_von_mises_Pa(
        unit_stress_at(analysis.responses, stress_point(spot)).front().data(), denser.values));
  const auto leads = std::size_t(std::max_element(crest_Pa.begin(), crest_Pa.end()) - crest_Pa.begin());
  if (leads > 0)
    add_crest(stress_point(spots[leads]), spots[leads].von_mises_Pa, spots.front().von_mises_Pa, analysis,
              analysis.hot_spot_errors);
}

}  // namespace

ChannelHistory at_denser_instants(const ChannelHistory& loads, Index most) {
  const Index n = loads.values.cols();
  ChannelHistory denser{loads.body, loads.channels, {}, loads.values, {}};
  if (n < 3 || !can_be_transformed(n)) return denser;
  std::map<std::string, double> largest;  // by unit
  for (Index k = 0; k < loads.values.rows(); ++k) {
    double& size = largest[loads.channels[std::size_t(k)].unit];
    size = std::max(size, loads.values.row(k).abs().maxCoeff());
  }
  Index highest = 0;
  std::vector<FactorSpectrum> spectra;
  for (Index k = 0; k < loads.values.rows(); ++k) {
    const double size = largest.at(loads.channels[std::size_t(k)].unit);
    spectra.push_back(factor_spectrum(loads.values.row(k), 0));
    for (Index h = 1; h < spectra.back().lines.cols(); ++h)
      if (line_size(spectra.back(), h) > least_line * size) highest = std::max(highest, h);
  }
  const Index times = std::min((per_period * highest + n - 1) / n, std::max(most / n, Index(2)));
  if (times < 2 || (n >= least_to_close && !is_closed(loads.values))) return denser;
  denser.values.resize(loads.values.rows(), times * n);
  for (Index k = 0; k < loads.values.rows(); ++k)
    denser.values.row(k) = series_of(spectra[std::size_t(k)].lines, times * n).transpose();
  return denser;
}

void add_crest_elsewhere(Judged& analysis, int n_threads) {
  const auto add = [&](const ChannelHistory& between) {
    add_crest_at_node(between, n_threads, analysis);
    add_crest_at_toe(between, analysis);
  };
  const auto& loads = analysis.loads.history;
  if (loads.passed_over.cols() > 0) add({loads.body, loads.channels, {}, loads.passed_over, {}});
  const auto denser = at_denser_instants(loads);
  if (denser.values.cols() != loads.values.cols()) add(denser);
}

Index n_superposed(const ChannelHistory& loads) {
  const Index own = loads.values.cols(), denser = at_denser_instants(loads).values.cols();
  return own + loads.passed_over.cols() + (denser != own ? denser : 0);
}

}  // namespace pipelines
