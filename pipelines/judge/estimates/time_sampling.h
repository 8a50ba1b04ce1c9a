/// What a stress may exceed its values at the instants of the load history, between them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "pipelines/loads/channels/channels.h"

namespace pipelines {

/// Excess of von Mises stress over the cycle above the largest of its values at the instants.
struct TimeSampling {
  double excess_Pa = 0;  ///< excess of the stress interpolated; exact where the instants resolve the factors
  double unresolved_Pa = 0;  ///< further excess that it may have; 0 where the instants resolve the factors
  double instant = 0;        ///< instant of the crest: i + share of the step to the next instant
  double error_Pa() const { return excess_Pa + unresolved_Pa; }
};

enum class SeriesKind { period, transient };

/// A stress whose spectrum is empty from a third of the number of instants on is resolved: its factors are
/// trigonometric polynomials, and the crest is found exactly. Others have the smaller of two bounds, of their
/// trigonometric polynomial and of polynomials through eight instants, each with what the instants leave
/// unresolved (superpose/between_instants/cycle_extremes.h); below 16 instants, of the first. Harmonics that
/// fall on lower ones because the instants meet them always at the same places cannot be seen. Of one and two
/// instants nothing is known: 0.
/// @param unit    per channel (xx, yy, zz, xy, yz, xz) [Pa]
/// @param values  channels x instants
/// @param kind    a transient has no polynomial of a period, and none is sought: its thousands of instants
/// may
///                have a large prime factor, with which a transform takes longer than all else
TimeSampling time_sampling(const std::vector<std::array<double, 6>>& unit, const Eigen::ArrayXXd& values,
                           SeriesKind kind = SeriesKind::period);

/// Excess of the largest stress under loads that the instants pass over (ChannelHistory::passed_over) above
/// the largest at these; 0: there is none.
double passed_over_excess_Pa(const std::vector<std::array<double, 6>>& unit, const ChannelHistory& loads);

/// Whether the instants pass over loads above the largest or below the smallest at these, by more than 1 % of
/// the size of a channel: more instants are needed than their spectra tell.
bool passes_over_much(const ChannelHistory& loads);

/// The loads that the instants pass over, where these are the whole course at denser instants, a multiple of
/// the instants; else none.
std::optional<ChannelHistory> denser_course(const ChannelHistory& loads);

/// Whether the loads that the instants pass over are the whole course at denser instants (denser_course).
bool is_whole_course(const ChannelHistory& loads);

/// What is known of the channels between the instants.
struct BetweenInstants {
  Eigen::ArrayXXd values;  ///< K x m; no columns: nothing
  bool is_whole = false;   ///< the course at equal steps, the instants among them: means are those of it
};

/// The loads that the instants pass over; without any, where the instants resolve all channels but are fewer
/// than 24 in a period of the highest line, the trigonometric polynomial through them.
BetweenInstants between_instants(const ChannelHistory& loads);

/// What the largest stress between the instants may exceed that at them by: the error_Pa of time_sampling, or
/// passed_over_excess_Pa if that is more. Where the loads that the instants pass over are the whole course at
/// denser ones, these are asked instead.
double sampling_error_Pa(const std::vector<std::array<double, 6>>& unit, const ChannelHistory& loads);

}  // namespace pipelines
