/// The error budget of a headline stress: what each source may be wrong by, and how that was found out.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_responses.h"
#include "fem/models/solid/model.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

/// Largest ratio of the true error to the plain estimate. Source: shafts of 2 to 16 cells per fillet quarter.
inline constexpr double discretisation_safety = 3;

/// One source of error of a von Mises stress.
struct ErrorEntry {
  std::string source;   ///< "time_sampling", "discretisation", ...
  std::string method;   ///< in a few words: how the figure was found
  double value_Pa = 0;  ///< estimate of the size, not negative
  /// Factor on the plain estimate that the value has in it: several meshes that agree may take it back.
  double safety = discretisation_safety;
  std::string condition{};  ///< on what the value rests: "if bearings press on 80 to 180 degrees in all"
};

/// Entries add up: signs are not known.
struct ErrorBudget {
  std::vector<ErrorEntry> numerical;  ///< errors of the calculation: finer runs make them smaller
  std::vector<ErrorEntry> model;      ///< errors of assumptions that no mesh mends

  double numerical_Pa() const;
  double total_Pa() const;
  /// What a finer mesh or a more expensive model lowers: all but the loads' own shape and what the scene
  /// leaves out.
  double reducible_Pa() const;
  /// Source of the largest numerical entry; empty without any.
  std::string largest() const;
  /// Source of the largest entry of reducible_Pa; empty without any.
  std::string largest_reducible() const;
  /// 0 if the budget has no such entry.
  double of(const std::string& source) const;
  /// ErrorEntry::safety of a numerical entry; 1 if there is no such entry.
  double safety_of(const std::string& source) const;
  // Replace the entry of that source, or add it.
  void set_numerical(const ErrorEntry& entry);
  void set_model(const ErrorEntry& entry);
};

/// Unit stress of a point by a submodel (submodels.h).
struct ResolvedStress {
  std::vector<std::array<double, 6>> unit_Pa;  ///< per channel
  double error_share = 0;  ///< error of the submodel itself, as a share of the von Mises stress
};

/// Where a headline stress comes from: the weighted sum of the stress at some nodes (one node for a peak, two
/// for a stress extrapolated to a weld toe), at one instant.
struct StressPoint {
  struct Part {
    std::size_t node = 0;
    double weight = 1;
  };
  std::vector<Part> parts;
  std::int32_t instant = 0;                          ///< column of ChannelHistory::values
  std::shared_ptr<const ResolvedStress> resolved{};  ///< in place of the nodes' stress, where there is one
};

/// Unit stress at the point, per channel (xx, yy, zz, xy, yz, xz) [Pa].
std::vector<std::array<double, 6>> unit_stress_at(const fem::UnitResponses& responses,
                                                  const StressPoint& point);

/// Von Mises stress of unit stresses times factors [Pa].
double von_mises_of(const std::vector<std::array<double, 6>>& unit, const Eigen::ArrayXd& factors);

/// What one run can tell about itself:
///   time_sampling       what the crest between the instants exceeds theirs by, and what they leave
///                       unresolved (time_sampling.h)
///   pressure_harmonics  what the harmonics above the highest one of each seat would bring, by their
///   pattern's
///                       closed form and the stress of those that were solved (solved_pressure.h)
///   discretisation      the largest difference between the recovered stress and that of one cell, over the
///                       faces around the point, times discretisation_safety: a single cell may agree by
///                       chance; of tetrahedra as tetrahedra_estimate.h, of resolved points as submodels.h
///   geometry            geometry_share
///   linear_solver       relative residual, or rounding if that is more
///   cancellation        the same share, and rounding, of the stress of all channels and effects that cancel
/// Responses without cells (cheap models) get no discretisation entry here.
/// @param geometry_share  as of the function of that name
/// @param left_out  one per node, or empty: what stress does there tells nothing of the point
ErrorBudget self_estimate(const StressPoint& point, const fem::UnitResponses& responses,
                          const BodyLoads& loads, const fem::Material& material, double geometry_share,
                          const std::vector<char>& left_out = {});

/// The entry "discretisation" of self_estimate alone, which costs a thousandth of all; nothing of responses
/// without cells.
std::optional<ErrorEntry> discretisation_estimate(const StressPoint& point,
                                                  const fem::UnitResponses& responses,
                                                  const ChannelHistory& history,
                                                  const fem::Material& material,
                                                  const std::vector<char>& left_out = {});

/// What faces beside their surfaces cost at a point, relative: bending stress goes with the third power of
/// the distance from the axis, a fillet's factor with the square root of its radius at most (sharp notches,
/// Creager and Paris 1967). The largest over the surfaces around the point, 3 of_axis + of_fillet / 2; three
/// times the largest error of the body, in radii, where none of them is curved.
double geometry_share(const fem::GeometryError& error, const fem::Nodes& nodes, const StressPoint& point);

/// What edges that are straighter than their surface (meshes::StraightEdge) cost at a point within their
/// length, relative: the angle in rad by which the largest of them leaves the surface at its ends, 4 off /
/// length of a parabola. Stress at a free surface turns with it, and a kink raises it by as much.
double straight_edge_share(const std::vector<meshes::StraightEdge>& edges, const fem::Nodes& nodes,
                           const StressPoint& point);

}  // namespace pipelines
