/// Stress of a body for viewers: its envelope over the cycle, and snapshots of the cycle.
///
/// Within the exclusion distance of a sharp edge stress has no converged value. Result fields are NaN there,
/// which VTK draws in a colour of its own and leaves out of ranges and thresholds; the values themselves have
/// fields of another name. A contour through such a place needs those, or a threshold "excluded" = 0 before
/// it (vtkContourFilter makes points of NaN otherwise).
#pragma once

#include <filesystem>
#include <string>

#include "kinetics/values/load_history.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Name of the field whose largest value is the reported peak.
inline constexpr const char* von_mises_field = "von Mises stress, maximum [Pa]";

/// Extrapolated to the nodes at weld toes, NaN elsewhere: its largest value is the reported hot-spot stress.
inline constexpr const char* hot_spot_field = "hot-spot stress at weld toes [Pa]";

/// 1 within the exclusion distances.
inline constexpr const char* excluded_field = "excluded";
/// Distance from the border of what is left out, negative within, beside that border; only in files that
/// leave something out.
inline constexpr const char* beyond_field = "distance beyond what is left out [m]";

/// 1 on the surface of the body.
inline constexpr const char* surface_field = "on the surface";

/// The field that has values at excluded nodes, too.
std::string unconverged(const std::string& field);

/// A field of the envelope that is finite all over the body, of von Mises stress.
std::string pictured_field(const Superposed& analysis);

/// envelope.vtu, or in several pieces envelope.pvtu with envelope_0.vtu ...; what an earlier run on another
/// number of ranks has left is removed. Field data "governing stress": value, position and place.
void write_envelope_files(const std::filesystem::path& directory, const Scene& scene,
                          const kinetics::LoadHistory& loads, const Judged& analysis, int n_pieces);

/// What envelope.vtu has, in one file of any name.
void write_whole_envelope(const std::filesystem::path& file, const Scene& scene,
                          const kinetics::LoadHistory& loads, const Judged& analysis);

/// cycle.pvd with cycle_*.vtu over the turn of the governing stress. Snapshots of an earlier run that this
/// one does not write are removed.
/// @param n_threads  that write files; their bytes are the same for any number
void write_cycle_files(const std::filesystem::path& directory, const Scene& scene,
                       const kinetics::LoadHistory& loads, const Judged& analysis, int n_threads = 1);

}  // namespace pipelines
