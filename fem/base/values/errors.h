/// What fem throws besides mistakes of the program, which are standard types.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fem {

/// A mesh that cannot be computed on: its file cannot be read, is cut off, has cells turned inside out or
/// pieces that hang together nowhere.
class MeshUnusable : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Local refinement turned cells inside out: their faces on larger neighbours keep these neighbours' shape,
/// and cells may be thinner than that is off. Cutting the larger ones mends it.
class InvertedBesideLarger : public MeshUnusable {
public:
  /// @param larger  indices of the larger neighbours, ascending: RefinementCycle::cells of a further cycle
  InvertedBesideLarger(const std::string& what, std::vector<std::int32_t> larger)
      : MeshUnusable(what), larger_(std::move(larger)) {}
  const std::vector<std::int32_t>& larger() const noexcept { return larger_; }

private:
  std::vector<std::int32_t> larger_;
};

/// Equations or an eigenvalue problem that no solver solved.
class SolveFailed : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A body too large for the memory that a machine has, or has left; the message names figures and remedy.
class DoesNotFit : public SolveFailed {
public:
  using SolveFailed::SolveFailed;
};

/// More natural frequencies than a mesh can tell: a user's mistake.
class TooManyModes : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace fem
