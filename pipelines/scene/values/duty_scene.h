/// Operating blocks of a scene ([[duty]]): how long it runs how, and how often it starts. Values in SI units.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace pipelines {

struct Scene;

/// Starts from rest to a block's running.
struct DutyStart {
  double per_day = 0;  ///< > 0
  /// Duration of the run-up at constant acceleration; none: the stress goes from nothing to that of running,
  /// with no transient between.
  std::optional<double> duration_s;
};

struct DutyBlock {
  std::string name;
  double share = 0;                ///< share of the time, (0, 1]; what is missing to 1 in all is standstill
  std::optional<DutyStart> start;  ///< none: the block follows another one without a stop
  std::shared_ptr<const Scene> scene;  ///< with the block's keys; without blocks of its own
  std::string origin;                  ///< "file:line:column: duty[2]", for errors that come after reading
};

}  // namespace pipelines
