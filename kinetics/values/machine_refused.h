/// What kinetics throws for a machine that its formulas refuse.
#pragma once

#include <stdexcept>

namespace kinetics {

/// A machine, an operating point or a choice of effects that the formulas do not hold for: a user's mistake.
/// The message names parameter, value and remedy. Anything else that kinetics throws is a mistake of the
/// program.
class MachineRefused : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

/// A load history that is not finite, or an eigenvalue search that did not end: the machine may be sound, the
/// arithmetic is not.
class LoadsFailed : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

}  // namespace kinetics
