#include "pipelines/judge/verdict/verdict.h"

#include <algorithm>
#include <utility>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/judge/verdict/findings.h"

namespace pipelines {
namespace {

void add(PartVerdict& part, const RunReport& report, std::optional<Finding> finding) {
  if (!finding || contains(report.scene.limits.left_out, finding->criterion)) return;
  part.judgement = std::max(part.judgement, finding->judgement);
  part.findings.push_back(*std::move(finding));
}

PartVerdict judge_body(const RunReport& report, const Judged& analysis) {
  PartVerdict part{analysis.scene.name, Judgement::ok, {}};
  add(part, report, judge_yield(report, analysis));
  add(part, report, judge_surface(report, analysis));
  add(part, report, judge_welds(report, analysis));
  add(part, report, judge_resonance(report, analysis));
  if (part.findings.empty())
    add(part, report,
        Finding{"nothing", Judgement::not_judged, "", "the scene leaves all criteria out", "", {}, {}});
  return part;
}

}  // namespace

std::string to_string(Judgement judgement) {
  return judgement == Judgement::ok ? "OK" : judgement == Judgement::not_ok ? "NOT OK" : "NOT JUDGED";
}

Judgement weigh(double margin, const std::optional<double>& least) {
  if (margin < 1) return Judgement::not_ok;
  return least && *least >= 1 ? Judgement::ok : Judgement::not_judged;
}

bool is_worse(const Finding& a, const Finding& b) {
  if (a.judgement != b.judgement) return a.judgement > b.judgement;
  const auto left = [](const Finding& finding) {
    if (finding.judgement == Judgement::not_ok) return finding.margin.value_or(0);
    return finding.least_margin.value_or(finding.margin ? 0 : 1e300);
  };
  return left(a) < left(b);
}

Verdict judge(const RunReport& report) {
  Verdict verdict;
  for (const auto& analysis : report.bodies) verdict.parts.push_back(judge_body(report, analysis));
  PartVerdict bearings{"bearings", Judgement::ok, {}}, train{"drive train", Judgement::ok, {}};
  for (auto& finding : judge_bearings(report)) add(bearings, report, std::move(finding));
  add(train, report, judge_torsion(report));
  verdict.left_out = report.scene.limits.left_out;
  for (const auto& analysis : report.bodies)
    if (analysis.scene.fatigue_off) verdict.left_out.push_back("fatigue of " + analysis.scene.name);
  for (auto* part : {&bearings, &train})
    if (!part->findings.empty()) verdict.parts.push_back(std::move(*part));
  verdict.judgement = verdict.parts.empty() ? Judgement::not_judged : Judgement::ok;
  for (const auto& part : verdict.parts) verdict.judgement = std::max(verdict.judgement, part.judgement);
  return verdict;
}

}  // namespace pipelines
