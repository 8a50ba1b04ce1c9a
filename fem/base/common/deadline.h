/// A limit of time that long work asks while it is at work, not only between its stages.
#pragma once

#include <stdexcept>

namespace fem {

/// The time was up, or what came next would have taken longer than was left. What was computed before stands.
class OutOfTime : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// While it lives, require_time throws on every thread of this process once these seconds are over. Of
/// several that live, the earliest counts. They end in the reverse of the order in which they began, as
/// scopes do.
class Deadline {
public:
  /// @param seconds  from now, by the clock on the wall; infinite: none
  explicit Deadline(double seconds);
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

private:
  double before_;  ///< end of the one around it
};

/// Seconds to the earliest deadline; infinite where there is none.
double seconds_to_deadline();

/// To be called within loops: by every range of parallel_for, before a factorisation and before a submodel.
/// @param seconds  that the next piece of work takes without an end in between
/// @throws OutOfTime if less is left
void require_time(double seconds = 0);

/// A predicted time of uninterrupted work in seconds of this machine as it is now: times what the last piece
/// took over its prediction, which is more where other programs are at work.
double at_present_pace(double predicted_s);

/// What a piece of work took, for at_present_pace. Pieces below a tenth of a second tell nothing.
void note_pace(double predicted_s, double taken_s);

}  // namespace fem
