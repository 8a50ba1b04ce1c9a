/// Runs side by side: what was put in, what came out, and whether the errors allow to tell a difference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/study/comparison/compared_run.h"

namespace pipelines {

/// How a figure b differs from a: (b - a) / |a| and, by the bounds of both, the least and the most that it
/// can be; nothing if a is 0.
struct Difference {
  double absolute = 0;
  std::optional<double> relative, least, most;
  bool is_none = false;   ///< both are the same number but for rounding
  bool is_told = false;   ///< the bounds of both do not meet
  bool is_stated = true;  ///< both figures have a bound

  /// "smaller by 12 +- 3 %", "larger by 110 % (12 to 260)", "the same", "no difference that the errors allow
  /// to tell", "larger by 2 %, without a stated error".
  std::string text() const;
};

/// How b differs from a; numbers that agree to 12 digits are called the same.
Difference difference(const FigureValue& a, const FigureValue& b);

struct ComparedFigure {
  FigureGroup group = FigureGroup::headline;
  std::string name, unit;
  std::vector<std::optional<FigureValue>> values;     ///< of each run
  std::vector<std::optional<Difference>> from_first;  ///< of each run from the first; nothing: one has none
};

struct ComparedKey {
  std::string key;
  std::vector<std::string> texts;  ///< of each run; empty: it has no such key
};

struct Comparison {
  std::vector<ComparedRun> runs;
  std::vector<ComparedKey> keys;  ///< those that are not the same in all runs
  std::vector<ComparedFigure> figures;
};

/// Figures of one name belong together; where a run has several, as zones at one fillet, the nearest ones.
Comparison compare_runs(std::vector<ComparedRun> runs);

}  // namespace pipelines
