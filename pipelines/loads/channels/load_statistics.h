/// What engineers take from a load history: extremes, harmonics, polar plots, load spectra.
#pragma once

#include <filesystem>
#include <vector>

#include "kinetics/train_crests.h"
#include "kinetics/values/load_history.h"

namespace pipelines {

/// Writes for every quantity that has statistics and every component of a resultant that is not zero
/// throughout:
///   statistics.csv  max, min, mean, RMS, and when the extremes occur
///   harmonics.csv   mean and lines up to the twelfth order of the drive: amplitude, phase of
///                   x = mean + sum A cos(order phi - phase) of the drive's angle phi; lines below 1e-9 of
///                   the largest are left out
///   polar.csv       magnitude and direction of the force of each resultant over the cycle
///   spectrum.csv    rainflow (ASTM E1049): range, mean, count, of one period
/// @param turns  turns of the drive that the history covers and after which it repeats; 0: it does not repeat
///               (a run-up): then there is no harmonics.csv, and spectrum.csv counts half cycles too
/// @param course what is known of quantities between the instants (course_of_loads): goes into statistics.csv
/// @throws FileError naming the file that cannot be written
void write_statistics(const std::filesystem::path& directory, const kinetics::LoadHistory& loads, int turns,
                      const std::vector<kinetics::CourseFigures>& course = {});

}  // namespace pipelines
