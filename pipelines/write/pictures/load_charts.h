/// Charts of what the load stage tells, as engineers draw it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/judge/figures/critical_speeds.h"
#include "pipelines/judge/verdict/torsion_report.h"

namespace pipelines {

/// Draws for the largest six resultants: histories (size over the drive's angle), polar (the force's path in
/// its frame), harmonics (amplitude of the force's components by order), and for the largest one rainflow
/// (cycles of its size by mean and range).
/// @param turns  turns of a steady period; 0: a run-up, which has no harmonics
/// @return the files that were written, PNG and SVG; empty if the machine offers no EGL
/// @throws FileError naming a file that cannot be written
std::vector<std::string> write_load_charts(const std::filesystem::path& directory, const std::string& title,
                                           const kinetics::LoadHistory& loads, int turns);

/// Draws campbell (natural frequencies and excitations over the reference shaft's speed) and modes (reduced
/// angles of the inertias).
/// @return, @throws  as write_load_charts
std::vector<std::string> write_torsion_charts(const std::filesystem::path& directory, const Scene& scene,
                                              const TorsionReport& report);

/// Draws campbell: whirl frequencies of a shaft over its speed, and the orders of its loads.
/// @return, @throws  as write_load_charts
std::vector<std::string> write_whirl_chart(const std::filesystem::path& directory, const std::string& title,
                                           const CriticalSpeeds& speeds);

}  // namespace pipelines
