#include "pipelines/judge/verdict/verdict_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "pipelines/base/names/nearest_name.h"
#include "pipelines/judge/verdict/findings.h"

namespace pipelines {
namespace {

using summary::Json;

std::vector<const Finding*> worst_first(const PartVerdict& part) {
  std::vector<const Finding*> findings;
  for (const auto& finding : part.findings) findings.push_back(&finding);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const auto* a, const auto* b) { return is_worse(*a, *b); });
  return findings;
}

/// "welds at web 2, lower edge"; without place the criterion alone.
std::string reason(const Finding& finding) {
  return finding.criterion + (finding.place.empty() ? "" : " at " + finding.place);
}

const PartVerdict* worst_part(const Verdict& verdict) {
  const auto found = std::find_if(verdict.parts.begin(), verdict.parts.end(),
                                  [&](const auto& part) { return part.judgement == verdict.judgement; });
  return found == verdict.parts.end() ? nullptr : &*found;
}

/// "12 h of 20,000 h wanted, at web 2; to do: ..."
std::string all_of_finding(const Json& row) {
  const auto text = [&](const std::string& before, const char* key) {
    const auto value = row.at(key).get<std::string>();
    return value.empty() ? "" : before + value;
  };
  return text("", "figure") + text(", at ", "place") + text("; to do: ", "remedy");
}

}  // namespace

std::string headline(const PartVerdict& part) {
  auto text = to_string(part.judgement);
  if (part.judgement == Judgement::ok || part.findings.empty()) return text;
  return text + ": " + reason(*worst_first(part).front());
}

std::string headline(const Verdict& verdict) {
  const auto text = to_string(verdict.judgement);
  const auto* part = worst_part(verdict);
  if (part == nullptr) return text + ": the run has no body and no bearing";
  if (verdict.judgement == Judgement::ok) return text;
  return text + ": " + part->name + ", " + reason(*worst_first(*part).front());
}

std::string left_out_text(const Verdict& verdict) {
  return verdict.left_out.empty() ? "" : "; not weighed: " + listed(verdict.left_out);
}

void print_verdict(std::ostream& out, const Verdict& verdict) {
  for (const auto& part : verdict.parts) {
    bool is_first = true;
    for (const auto* finding : worst_first(part)) {
      out << fmt::format("  {:<11} {:<10}  {}: {}{}\n", is_first ? part.name : "",
                         is_first || finding->judgement != Judgement::ok ? to_string(finding->judgement) : "",
                         finding->criterion, finding->figure,
                         finding->place.empty() ? "" : ", at " + finding->place);
      if (finding->judgement != Judgement::ok && !finding->remedy.empty())
        out << fmt::format("  {:<22}    -> {}\n", "", finding->remedy);
      is_first = false;
    }
  }
}

FieldTable<Finding> finding_fields() {
  using Field = FieldOf<Finding>;
  const auto margin = [](const char* key, const char* meaning, std::optional<double> Finding::*of) {
    return Field(key, quantities::ratio, meaning,
                 [=](const Finding& f) { return f.*of ? summary::number_or_none(*(f.*of)) : Json(nullptr); });
  };
  return without_csv(FieldTable<Finding>{
      {"judgement", quantities::text, "`OK`, `NOT JUDGED` or `NOT OK`", "verdict",
       [](const Finding& f) { return to_string(f.judgement); }},
      {"criterion", quantities::text, "what is weighed", "criterion", &Finding::criterion},
      Field("figure", quantities::text, "with its error and its limit",
            "figure and limit, at the weakest place", &Finding::figure)
          .shown_as(all_of_finding),
      {"place", quantities::text, "the weakest", &Finding::place},
      {"remedy", quantities::text, "what to do, or what is missing", &Finding::remedy},
      margin("margin", "factor on all loads at which the limit is met; null: no figure", &Finding::margin),
      margin("margin_least", "what the whole error leaves of it; null: not known", &Finding::least_margin),
  });
}

Json verdict_json(const Verdict& verdict) {
  auto json = summary::object({{"judgement", to_string(verdict.judgement)},
                               {"headline", headline(verdict)},
                               {"left_out", verdict.left_out},
                               {"parts", Json::object()}});
  for (const auto& part : verdict.parts) {
    auto& entry = json["parts"][part.name];
    entry = summary::object({{"judgement", to_string(part.judgement)}, {"findings", Json::array()}});
    for (const auto* finding : worst_first(part))
      entry["findings"].push_back(summary_row(finding_fields(), *finding));
  }
  return json;
}

}  // namespace pipelines
