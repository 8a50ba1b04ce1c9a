/// A verdict in the terminal and in summary.json.
#pragma once

#include <iosfwd>
#include <string>

#include "pipelines/base/fields/field.h"
#include "pipelines/judge/verdict/verdict.h"

namespace pipelines {

/// "NOT OK: chamber, welds at web 2, lower edge": the judgement and its first reason.
std::string headline(const Verdict& verdict);

/// The same of one body: "NOT OK: welds at web 2, lower edge".
std::string headline(const PartVerdict& part);

/// A line for each criterion of each part, the worst first, with what to do below what does not hold.
void print_verdict(std::ostream& out, const Verdict& verdict);

/// "; not weighed: resonance": what the scene leaves out, behind other words; empty: nothing.
std::string left_out_text(const Verdict& verdict);

/// verdict.parts.<part>.findings.
FieldTable<Finding> finding_fields();

/// {"judgement", "headline", "left_out", "parts": {name: {"judgement", "findings": [...]}}}
summary::Json verdict_json(const Verdict& verdict);

}  // namespace pipelines
