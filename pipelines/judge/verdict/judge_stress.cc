/// Yield, and what resonance adds.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/base/common/constants.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/life/duty_result.h"
#include "pipelines/judge/stages/start_up_stress.h"
#include "pipelines/judge/verdict/findings.h"
#include "pipelines/judge/verdict/size_remedy.h"

namespace pipelines {
namespace {

/// A stress that is held against the yield strength.
struct Stressed {
  double value_Pa = 0, error_share = 0;  ///< whole error
  std::string place, when;               ///< when: " in block fine"; empty: running
};

/// The governing stress of running; without operating blocks, or with blocks that have other places.
Stressed in_running(const Judged& analysis) {
  const auto stress = governing_stress(analysis);
  const double share = stress.value_Pa > 0 ? stress.errors.total_Pa() / stress.value_Pa : 0;
  return {stress.value_Pa, share, stress.place, ""};
}

/// Blocks are known as well as running is, but for what lies between their instants.
std::vector<Stressed> in_blocks(const RunReport& report, const Judged& analysis) {
  std::vector<Stressed> all;
  if (report.duty == nullptr) return all;
  const double error_share = in_running(analysis).error_share;
  for (const auto& block : report.duty->blocks)
    for (const auto& stress : block.stresses)
      if (stress.body == analysis.scene.name && stress.value_Pa > 0)
        all.push_back({stress.value_Pa, error_share + stress.sampling_error_Pa / stress.value_Pa,
                       stress.feature, " in block " + block.name});
  return all;
}

std::vector<Stressed> all_stresses(const RunReport& report, const Judged& analysis) {
  std::vector<Stressed> all{in_running(analysis)};
  for (auto& stress : in_blocks(report, analysis)) all.push_back(std::move(stress));
  // A start is known no better than running: what patterns of pressure leave open is the same.
  if (analysis.start_up)
    all.push_back({analysis.start_up->von_mises.largest,
                   std::max(analysis.start_up->error_share, all.front().error_share),
                   analysis.start_up->feature, " in the start"});
  return all;
}

std::string remedy_of_yield(double yield_Pa, double least_margin) {
  return fmt::format(
      "the loads have to come down by a factor {:.2f}, or the yield strength rise to {:.0f} MPa",
      1 / least_margin, yield_Pa / least_margin / 1e6);
}

Finding finding_of(const RunReport& report, const Judged& analysis, const Stressed& stress) {
  Finding finding{"yield", Judgement::ok, stress.place + stress.when, "", "", std::nullopt, std::nullopt};
  const double wanted = report.scene.limits.yield_safety, yield_Pa = analysis.scene.yield_strength_Pa;
  if (!(stress.value_Pa > 0)) {
    finding.place.clear();
    finding.figure = "no stress";
    return finding;
  }
  const double safety = yield_Pa / stress.value_Pa;
  finding.margin = safety / wanted;
  if (std::isfinite(stress.error_share)) finding.least_margin = *finding.margin / (1 + stress.error_share);
  finding.judgement = weigh(*finding.margin, finding.least_margin);
  finding.figure = fmt::format("safety {} ({}) of {:g} wanted, {} MPa", fixed(safety, 2),
                               finding.least_margin ? fixed(*finding.least_margin * wanted, 2) : "-", wanted,
                               with_error(stress.value_Pa, stress.error_share * stress.value_Pa));
  if (finding.judgement == Judgement::not_ok) {
    const double least = finding.least_margin.value_or(*finding.margin);
    finding.remedy = remedy_of_yield(yield_Pa, least);
    if (stress.when.empty()) finding.remedy += size_remedy(analysis, 1 / least);
  } else if (finding.judgement == Judgement::not_judged)
    finding.remedy = remedy_of_open(analysis, stress.error_share);
  return finding;
}

}  // namespace

std::string remedy_of_open(const Judged& analysis, double error_share) {
  constexpr double same = 1.5;
  const auto running = in_running(analysis);
  const auto begin = std::isfinite(error_share)
                         ? fmt::format("its error of {:.2g} % leaves it open: ", 100 * error_share)
                         : std::string("its error is not known: ");
  if (error_share > same * running.error_share)
    return begin +
           "the place is known less well than what governs; a smaller --tolerance, or a finer mesh there";
  return begin + remedy_of_error(governing_stress(analysis).errors, analysis.search);
}

Finding judge_yield(const RunReport& report, const Judged& analysis) {
  Finding worst;
  for (const auto& stress : all_stresses(report, analysis)) {
    auto finding = finding_of(report, analysis, stress);
    if (worst.criterion.empty() || is_worse(finding, worst)) worst = std::move(finding);
  }
  if (const auto rise = rises_towards_edge(analysis); !rise.empty() && worst.judgement != Judgement::not_ok) {
    worst.judgement = Judgement::not_judged;
    worst.remedy = rise;
  }
  return worst;
}

namespace {

Finding judge_amplification(const RunReport& report, const Vibration& vibration) {
  Finding finding{"resonance", Judgement::ok, "", "", "", std::nullopt, std::nullopt};
  const double limit = report.scene.limits.dynamic_amplification;
  const double factor = 1 + std::max(vibration.to_peak.share, vibration.to_hot_spot.share);
  finding.margin = limit / factor;
  finding.least_margin = finding.margin;  // the bound counts the frequencies' errors
  finding.judgement = weigh(*finding.margin, finding.least_margin);
  finding.place = vibration.to_peak.place;
  const auto& natural = vibration.natural_frequencies;
  finding.figure =
      fmt::format("{}resonance puts at most a factor {:.2f} on the stress, {:g} is allowed",
                  natural.empty() ? std::string()
                                  : fmt::format("lowest natural frequency {:.4g} Hz ({:.4g}), ",
                                                natural.front().value_Hz, natural.front().least_Hz()),
                  factor, limit);
  if (finding.judgement != Judgement::ok)
    finding.remedy =
        fmt::format("another speed, or a stiffer body: harmonic {:.3g} shakes it at {:.4g} Hz",
                    vibration.amplification.highest.order, vibration.amplification.highest.frequency_Hz);
  return finding;
}

/// What the frequency of a beam may be off where no solid tells: three times the most that was seen
/// (fem/models/README.md).
constexpr double beam_alone = 0.1;

/// The nearest critical speed, as those of a drive train in torsion are weighed.
Finding judge_critical_speed(const RunReport& report, const CriticalSpeeds& speeds) {
  Finding finding{"resonance", Judgement::ok, "", "no load meets a whirl", "", std::nullopt, std::nullopt};
  const auto load = governing_load(speeds);
  if (!load) return finding;
  const double limit = report.scene.limits.resonance_margin, margin = std::abs(load->margin);
  const double error = load->error_rad_s / load->speed_rad_s + speeds.model_error.value_or(beam_alone);
  finding.margin = margin / limit;
  finding.least_margin = std::max(margin - error, 0.0) / limit;
  finding.judgement = weigh(*finding.margin, finding.least_margin);
  finding.figure =
      fmt::format("{} meets the whirl at {:.4g} rpm, {:.1f} % from there; {:g} % are wanted",
                  load_name(load->order), load->speed_rad_s * 30 / pi, 100 * margin, 100 * limit);
  if (finding.judgement == Judgement::not_judged && !speeds.model_error)
    finding.remedy = fmt::format(
        "natural_frequencies = 2 tells the beam's own error, for which {:g} % are taken", 100 * beam_alone);
  else if (finding.judgement != Judgement::ok)
    finding.remedy = "another speed, stiffness of the bearings, or diameter";
  return finding;
}

}  // namespace

Finding judge_resonance(const RunReport& report, const Judged& analysis) {
  std::optional<Finding> worst;
  if (analysis.vibration) worst = judge_amplification(report, *analysis.vibration);
  if (analysis.critical_speeds) {
    auto finding = judge_critical_speed(report, *analysis.critical_speeds);
    if (!worst || is_worse(finding, *worst)) worst = std::move(finding);
  }
  if (worst) return *std::move(worst);
  return {"resonance",
          Judgement::not_judged,
          "",
          "natural frequencies were not asked for",
          fmt::format("natural_frequencies = 3 in [{}]", analysis.scene.name),
          std::nullopt,
          std::nullopt};
}

}  // namespace pipelines
