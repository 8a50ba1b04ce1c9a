/// What one mesh tells of the stress at each place of a body.
#pragma once

#include <limits>
#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/estimates/place_stress.h"

namespace pipelines {

/// Share of the largest stress: below it a place is taken to be as wrong as it can be.
constexpr double share_worth_a_look = 0.4;

/// The features of a body and its inside, and its weld toes by their hot-spot stress. The error of a place is
/// that of self_estimate there; far below the largest stress it is the stress itself, which is cheaper and
/// says enough. On shafts of blocks it counts half as much again at bores,
/// and beside sharp shoulders cells that are large beside what is left out add an error that stays. A fillet
/// with few cells has an error that says so: half of its stress with 2 cells on its quarter, 15 % with 4, 4 %
/// with more (the largest found on 60 random shafts, `tests/benchmarks/run promises`, are 31, 10 and 3 %).
/// Below cells_that_converge it keeps that error, however well meshes agree.
/// @param submodels_s  of tetrahedra: seconds in which submodels may tell the errors of places that may lead,
///                     those first that may be largest; 0: none. What is left then has twice the error that
///                     cells around tell.
std::vector<PlaceStress> places_of_one_mesh(const Judged& analysis,
                                            double submodels_s = std::numeric_limits<double>::infinity());

/// Enters what is known of the places into the error budget of the governing stress: its own error as the
/// entry `discretisation`, and as `other_places` by how much another place with its error exceeds it with its
/// own; likewise into that of the peak, where a weld toe governs, from the places that are no weld toes.
/// Keeps the places, and gives the zones their errors.
void take_place_errors(Judged& analysis, const std::vector<PlaceStress>& judged, const std::string& method);

/// What is known of the stress at a node of a feature that is judged, as a share of it: at the node of the
/// place's maximum what the search knows. Elsewhere between what the mesh tells of it by itself, and as many
/// times more than at the maximum as the mesh doubts the stress there more: their geometric mean, the former
/// with three times the weight; not more than it. A search cuts cells at the maximum: on the other side of a
/// fillet they may be as large as they were, and their stress off by 6 % where the maximum is known to 0.8 %.
/// And that harmonics agree at the maximum says little of elsewhere: in a tube whose bore was known to 1.5 %
/// at its end, with 9.7 % by single cells, it was off by 6.3 % at another zone, with 11.7 %: equal weights
/// said 5.2 %.
/// @param loads    of the stress, with the channels of the analysis' responses
/// @param instant  column of `loads`
/// @return infinite if the feature is not judged
double error_share_at(const Judged& analysis, const std::string& feature, std::size_t node,
                      const ChannelHistory& loads, std::int32_t instant);
/// The relative error of the largest stress there over the cycle.
double error_share_at(const Judged& analysis, const std::string& feature, std::size_t node);

/// The numerical error of half a change of the stress, of an amplitude, at a node of a feature that is
/// judged, as a share of it, without that of time sampling. The part that has the direction of the largest
/// stress there is known as well as that (error_share_at). The rest was never judged: under a steady torque
/// and bending that goes round, the largest stress may be the torque's, and the amplitude the bending's. It
/// has what single cells tell of it.
/// @param change  half of the change, as loads of one instant
/// @return infinite if the feature is not judged
double error_share_of_change(const Judged& analysis, const std::string& feature, std::size_t node,
                             const BodyLoads& change);

/// The whole error of an amplitude, as a share of it: error_share_of_change, what the instants leave
/// unresolved, and what load patches (load_patch_error_Pa) and the other assumptions leave open
/// (model_error_share); where the body's peak is, not less
/// than what is stated of that.
/// @param unresolved_share  by how much the amplitude may be larger than at the instants
/// @return infinite if the feature is neither judged nor has the peak
double whole_error_share_of_change(const Judged& analysis, const std::string& feature, std::size_t node,
                                   const BodyLoads& change, double unresolved_share);

/// What the mesh and the loads tell of the error at a point (self_estimate).
ErrorBudget errors_at(const StressPoint& point, const Superposed& analysis);

/// A zone at a place that is judged has the discretisation error of its peak's node there (error_share_at);
/// the first n_zones_shown have their other numerical errors too.
void take_zone_errors(Judged& analysis);

/// Cells on the quarter of a fillet, on a locally refined mesh the fewest beside the place's maximum; 0 for
/// places that are no fillets of a shaft of blocks.
int cells_on_quarter(const Responded& analysis, const PlaceStress& place);

}  // namespace pipelines
