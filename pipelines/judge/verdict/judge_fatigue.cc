/// Fatigue of the surface and of weld toes.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/life/duty_result.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/judge/texts/zone_text.h"
#include "pipelines/judge/verdict/findings.h"
#include "pipelines/judge/verdict/size_remedy.h"

namespace pipelines {
namespace {

/// A place or a weld toe, of running or over all operating blocks.
struct Used {
  std::string place;
  bool is_weld = false;
  std::optional<double> life_s;       ///< none: endures
  std::optional<double> life_safety;  ///< factor on all stresses; none: nothing changes
  double error_share = 0;             ///< infinite: not known
  const LifeCertainty* certainty = nullptr;
  double range_Pa = 0;  ///< range of the largest cycle: twice the amplitude
  std::string brought_by;
  bool over_blocks = false;
};

/// @param shares  empty where nothing changes
std::string brought_by(const std::vector<std::string>& effects, const std::vector<double>& shares) {
  if (shares.empty()) return "";
  return largest_shares(group_shares(effects, shares));
}

std::vector<Used> of_running(const Judged& analysis) {
  std::vector<Used> all;
  const auto& effects = analysis.loads.history.effects;
  for (const auto& place : analysis.fatigue->places)
    all.push_back({place.feature, false, place.life_s, place.life_safety, place.error_share, &place.certainty,
                   2 * place.cycle.amplitude_Pa, brought_by(effects, place.effect_share)});
  for (const auto& weld : analysis.fatigue->welds)
    all.push_back({weld.name, true, weld.life_s, weld.life_safety, weld.error_share, &weld.certainty,
                   weld.range_Pa, brought_by(effects, weld.effect_share)});
  return all;
}

std::vector<Used> over_blocks(const DutyResult& duty, const std::string& body,
                              const std::vector<DutyPlace>& places) {
  std::vector<Used> all;
  const auto& effects = duty.effects.at(body);
  for (const auto& place : places) {
    double amplitude_Pa = 0;
    for (const auto& block : place.blocks)
      amplitude_Pa = std::max({amplitude_Pa, block.amplitude_Pa, block.start_amplitude_Pa});
    all.push_back({place.feature, place.is_weld, place.life_s, place.life_safety, place.error_share,
                   &place.certainty, 2 * amplitude_Pa, brought_by(effects, place.effect_share), true});
  }
  return all;
}

std::vector<Used> all_used(const RunReport& report, const Judged& analysis) {
  const auto& body = analysis.scene.name;
  if (report.duty != nullptr)
    if (const auto found = report.duty->places.find(body); found != report.duty->places.end())
      return over_blocks(*report.duty, body, found->second);
  return of_running(analysis);
}

/// Elastic stress says nothing of a life where the S-N curve does not hold: the largest cycle is too large.
Judgement judgement_of(const Used& used) {
  if (!(used.range_Pa > 0)) return Judgement::ok;
  if (!used.life_safety) return Judgement::not_judged;
  if (!used.certainty->beyond.empty()) return Judgement::not_ok;
  return weigh(*used.life_safety, least_safety(*used.life_safety, used.error_share));
}

std::string remedy_of_life(const Judged& analysis, const Used& used, double least) {
  auto text = fmt::format("the range of {} MPa has to come down by a factor {:.2f}",
                          fixed(used.range_Pa / 1e6, 1), 1 / least);
  text += size_remedy_of_fatigue(analysis, used.place, 1 / least, !used.over_blocks);
  if (!used.brought_by.empty()) text += "; it comes from " + used.brought_by;
  return text;
}

Finding finding_of(const Judged& analysis, const Used& used) {
  Finding finding{used.is_weld ? "welds" : "fatigue",
                  judgement_of(used),
                  used.place,
                  "",
                  "",
                  used.life_safety,
                  std::nullopt};
  if (!(used.range_Pa > 0)) {
    finding.place.clear();
    finding.figure = "the stress does not change";
    return finding;
  }
  if (!used.life_safety) {
    finding.figure = life_text(used.life_s, *used.certainty) + ", no safety against the wanted life is known";
    return finding;
  }
  finding.least_margin = least_safety(*used.life_safety, used.error_share);
  finding.figure = life_text(used.life_s, *used.certainty) +
                   fmt::format(" of {} wanted", hours_text(*analysis.scene.fatigue->wanted_life_s));
  if (!used.life_s)
    finding.figure += fmt::format(", stress may be {:.2f} times as large ({})", *used.life_safety,
                                  finding.least_margin ? fmt::format("{:.2f}", *finding.least_margin) : "-");
  if (finding.judgement == Judgement::not_ok)
    finding.remedy =
        remedy_of_life(analysis, used, std::min(1.0, finding.least_margin.value_or(*finding.margin)));
  else if (finding.judgement == Judgement::not_judged)
    finding.remedy = remedy_of_open(analysis, used.error_share);
  return finding;
}

/// A strength of which nobody says that it is the part's at its size may be that of the standard's sample,
/// and less by FKM's size factor: the margin has to hold with that too.
void weigh_size(const Judged& analysis, Finding& finding) {
  constexpr double same_strength = 0.995;
  const auto& sizes = analysis.fatigue->at_size;  // the least factor last
  if (sizes.empty() || sizes.back().size.tensile_factor > same_strength || !finding.margin) return;
  finding.figure += "; R_m taken as that of the part at its size";
  if (finding.least_margin) *finding.least_margin *= sizes.back().size.tensile_factor;
  if (finding.judgement != Judgement::ok) return;
  finding.judgement = weigh(*finding.margin, finding.least_margin);
  if (finding.judgement == Judgement::ok) return;
  finding.remedy = fmt::format(
      "say which size R_m is for: size_factor = {:.3g} in [{}.fatigue] where it is the standard's "
      "sample's, 1 where it is the part's",
      sizes.back().size.tensile_factor, analysis.scene.name);
}

/// @param welds  toes alone, or all but these
std::optional<Finding> worst_of(const RunReport& report, const Judged& analysis, bool welds) {
  std::optional<Finding> worst;
  for (const auto& used : all_used(report, analysis)) {
    if (used.is_weld != welds) continue;
    auto finding = finding_of(analysis, used);
    if (!welds) weigh_size(analysis, finding);
    if (!worst || is_worse(finding, *worst)) worst = std::move(finding);
  }
  return worst;
}

std::optional<Finding> not_judged(const Responded& analysis, const char* criterion) {
  if (analysis.scene.fatigue_off) return std::nullopt;
  const auto& why = analysis.scene.fatigue_missing;
  return Finding{criterion,    Judgement::not_judged, "", "not known", why.empty() ? "no rule holds" : why,
                 std::nullopt, std::nullopt};
}

}  // namespace

std::optional<Finding> judge_surface(const RunReport& report, const Judged& analysis) {
  if (!analysis.fatigue) return not_judged(analysis, "fatigue");
  auto worst = worst_of(report, analysis, false);
  if (!worst) return worst;
  const auto rise = rises_towards_edge(analysis);
  if (!rise.empty() && worst->judgement == Judgement::ok) {
    worst->judgement = Judgement::not_judged;
    worst->remedy = rise;
  }
  return worst;
}

std::optional<Finding> judge_welds(const RunReport& report, const Judged& analysis) {
  if (analysis.hot_spots.empty() && analysis.mesh.notches.empty()) return std::nullopt;
  return analysis.fatigue ? worst_of(report, analysis, true) : not_judged(analysis, "welds");
}

}  // namespace pipelines
