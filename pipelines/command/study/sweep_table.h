/// What `millstress sweep` prints of its points, and how figures are shown in tables and charts.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/command/study/sweep_command_options.h"
#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {

/// Whether a figure is the governing stress of a body.
bool is_governing(const std::string& figure);

/// The figures that are shown: those named, governing stresses, or else the largest forces of the first
/// point, of which a drive train has none: its torques.
/// @throws OptionError for a name that no row has
std::vector<std::string> shown_figures(const std::vector<std::string>& named,
                                       const std::vector<SweepRow>& rows);

/// SI unit of a figure, from the first row that has it; empty if none has it.
std::string unit_of(const std::vector<SweepRow>& rows, const std::string& figure);
std::string with_unit(const std::string& name, const std::string& unit);

/// Keys that change no figure of any two points that differ by them alone; none of a Latin hypercube's.
std::vector<std::string> keys_without_effect(const SweepPlan& plan, const std::vector<SweepRow>& rows);

/// A line per point, up to sixty.
void print_points(std::ostream& out, const SweepPlan& plan, const std::vector<SweepRow>& rows,
                  const std::vector<std::string>& figures);

/// The point where each figure is largest, and how to look at it.
void print_extremes(std::ostream& out, const SweepCommandOptions& options, const SweepPlan& plan,
                    const std::vector<SweepRow>& rows, const std::vector<std::string>& figures);

/// What becomes of each zone over the points.
/// @param numbers  numbers of the zones, by point (follow_zones)
void print_zones(std::ostream& out, const std::vector<SweepRow>& rows,
                 const std::vector<std::vector<int>>& numbers);

}  // namespace pipelines
