/// What an engineer decides on: whether the machine holds, first of all that a run says.
///
/// Each criterion (yield, fatigue of the surface, weld toes, resonance of each body; bearings; torsional
/// resonance of a drive train) is weighed at its weakest place against what the scene asks for ([limits],
/// FKM's safety factor, IIW's class with gamma_M), with the whole error of the figure. A criterion holds
/// where it does so with its error added; where the figure alone holds, its error leaves it open, and it
/// counts as not judged.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/judge/texts/run_report.h"

namespace pipelines {

enum class Judgement { ok, not_judged, not_ok };  ///< by rising weight

/// "OK", "NOT JUDGED", "NOT OK"
std::string to_string(Judgement judgement);

/// One criterion at its weakest place.
struct Finding {
  std::string criterion;  ///< one of names_of_criteria
  Judgement judgement = Judgement::ok;
  std::string place;             ///< feature, weld toe, bearing; may be empty
  std::string figure;            ///< with its error and its limit
  std::string remedy;            ///< what to do, or what is missing and the lines that add it; empty: nothing
  std::optional<double> margin;  ///< factor on all loads at which the limit is met; none: no figure
  std::optional<double> least_margin;  ///< what the whole error leaves of it; none: not known
};

/// A body, or what belongs to the machine as a whole ("bearings", "drive train").
struct PartVerdict {
  std::string name;
  Judgement judgement = Judgement::ok;  ///< the worst of the findings
  std::vector<Finding> findings;
};

struct Verdict {
  Judgement judgement = Judgement::ok;  ///< the worst of the parts; not judged where there is none
  std::vector<PartVerdict> parts;
  std::vector<std::string> left_out;  ///< what the scene does not ask for: "resonance", "fatigue of shaft"
};

/// @param report  report of a run, with all that its scene asks for
Verdict judge(const RunReport& report);

}  // namespace pipelines
