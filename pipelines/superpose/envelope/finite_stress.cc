#include "pipelines/superpose/envelope/finite_stress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/finite.h"

namespace pipelines {
namespace {

/// Index of the first value that is not finite; -1: none.
template <typename Values>
Eigen::Index first_fault(const Values& values) {
  if (values.size() == 0 || values.allFinite()) return -1;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values(i))) return i;
  return -1;
}

/// Checks one value for each node, or several.
template <typename Number>
void check_nodes(const std::string& stage, const std::string& what, const std::vector<Number>& values,
                 std::size_t per_node) {
  using Array = Eigen::Array<Number, Eigen::Dynamic, 1>;
  const Eigen::Map<const Array> all(values.data(), Eigen::Index(values.size()));
  if (const auto at = first_fault(all); at >= 0)
    refuse_not_finite(stage, what,
                      fmt::format(" at node {}", std::size_t(at) / std::max<std::size_t>(1, per_node)));
}

void check_maximum(const std::string& stage, const std::string& what, const NodalMaximum& maximum) {
  check_nodes(stage, what, maximum.value_Pa, 1);
  for (std::size_t i = 0; i < maximum.stress_Pa.size(); ++i)
    for (const double component : maximum.stress_Pa[i])
      if (!std::isfinite(component)) refuse_not_finite(stage, what, fmt::format(" at node {}", i));
}

}  // namespace

void require_finite(const fem::UnitResponses& responses) {
  const auto n_channels = responses.channels.size();
  // On a body that ranks share, a node's number is its place among those of the rank.
  check_nodes("solve", "the displacement for a unit load [m]", responses.displacement_m, 3 * n_channels);
  check_nodes("stress recovery", "the stress for a unit load [Pa]", responses.stress_Pa, 6 * n_channels);
  for (const auto& section : responses.sections)
    for (const double component : section.resultant)
      require_finite("solve", "the resultant of a section [N, N m]", component);
}

void require_finite(const std::string& body, const Envelope& envelope) {
  const std::string stage = "superposition on the " + body;
  check_maximum(stage, "the von Mises stress [Pa]", envelope.von_mises);
  check_maximum(stage, "the largest principal stress [Pa]", envelope.principal);
  const auto n = std::max<std::size_t>(1, envelope.von_mises.value_Pa.size());
  check_nodes(stage, "an effect's share of the stress", envelope.effect_share,
              envelope.effect_share.size() / n);
}

}  // namespace pipelines
