/// Stress of a body for viewers: its envelope over the cycle, and snapshots of the cycle.
///
/// Within the exclusion distance of a sharp edge stress has no converged value. Fields keep what was computed
/// there, so that viewers draw and contour them without holes, and a field of its own says where that is:
/// whoever looks for a largest value takes nodes whose `left_out` is 0 alone. Stresses stand in Pa, and once
/// more in MPa for people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Name of the field whose largest value outside what is left out is the reported peak.
inline constexpr const char* von_mises_field = "von Mises stress, maximum [Pa]";

/// Extrapolated to the nodes at weld toes, NaN elsewhere: its largest value is the reported hot-spot stress.
inline constexpr const char* hot_spot_field = "hot-spot stress at weld toes [Pa]";

/// 1 within the exclusion distances, 0 elsewhere.
inline constexpr const char* excluded_field = "left_out";
/// Distance from the border of what is left out, negative within, beside that border; only in files that
/// leave something out.
inline constexpr const char* beyond_field = "distance beyond what is left out [m]";

/// 1 on the surface of the body.
inline constexpr const char* surface_field = "on the surface";

/// The field of a stress in MPa, beside the one in Pa: "von Mises stress, maximum [MPa]".
std::string in_MPa(const std::string& field);

/// envelope.vtu, or in several pieces envelope.pvtu with envelope_0.vtu ... Field data: the governing stress
/// with position and place, names of zones, ports and features. Called on all ranks that share the body.
void write_envelope_files(const std::filesystem::path& directory, const Scene& scene,
                          const kinetics::LoadHistory& loads, const Judged& analysis, int n_pieces);

/// What envelope.vtu has, in one file of any name; of a body that ranks share without the displacement, which
/// all of them would have to bring.
void write_whole_envelope(const std::filesystem::path& file, const Scene& scene,
                          const kinetics::LoadHistory& loads, const Judged& analysis);

/// cycle.pvd with cycle_*.vtu over the turn of the governing stress. Snapshots of an earlier run that this
/// one does not write are removed.
/// @param n_threads  that write files; their bytes are the same for any number
void write_cycle_files(const std::filesystem::path& directory, const Scene& scene,
                       const kinetics::LoadHistory& loads, const Judged& analysis, int n_threads = 1);

/// bodies.vtm, which opens the envelopes of all bodies as one, and paraview_view.py, which shows them.
/// @param directory  in which the bodies' folders are
/// @param n_pieces   as write_envelope_files
void write_bodies_together(const std::filesystem::path& directory, const std::vector<std::string>& bodies,
                           int n_pieces);

}  // namespace pipelines
