/// A drive train in torsion: natural frequencies, modes, forced response, Campbell table, resonance margins.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "kinetics/published_tables.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Torque of one element in the steady state under the excitations that are on.
struct ElementTorque {
  std::string element;
  double mean_Nm = 0;             ///< on the shaft of its first inertia
  double largest_Nm = 0;          ///< largest |T| over the scene's window
  double largest_reduced_Nm = 0;  ///< the same on the reference shaft
  double largest_shear_Pa = 0;    ///< K_t T r / I_p; zero where no diameter is given
};

/// An excitation frequency against the nearest natural frequency, and what it brings.
struct LineMargin : kinetics::ResonanceMargin {
  /// Torque's amplitude at this frequency, of all excitations that have it, over the largest torque of the
  /// same element: of the element where that is most.
  double torque_share = 0;
};

/// What tables show of margins: distance from a natural frequency, share of a torque.
inline constexpr double near_resonance = 0.2, felt_torque_share = 0.05;

struct TorsionReport {
  kinetics::NaturalModes modes;
  kinetics::ForcedResponse forced;
  std::vector<ElementTorque> torques;
  std::vector<LineMargin> margins;  ///< closest first
  kinetics::CampbellTable campbell;
  std::optional<kinetics::Transient> transient;        ///< where the scene asks for it
  std::optional<kinetics::PublishedTables> published;  ///< where the scene asks for them
};

/// @param machine  the scene's, with the inertias that it leaves to a mesh
/// @throws StageRefused if the scene's machine is no drive train; as kinetics does; NotFinite
TorsionReport report_torsion(const Scene& scene, const Machine& machine);

/// @param all  every excitation frequency, not only those that matter
void print_torsion(std::ostream& out, const Scene& scene, const TorsionReport& report, bool all = false);
std::string torsion_json(const Scene& scene, const TorsionReport& report);

/// Writes into `directory`: modes.csv (frequencies, shapes, energy shares), forced.csv (amplitude and phase
/// of every harmonic at every inertia and element), campbell.csv, margins.csv; transient.csv (torque and
/// angle over time, energies) and the paper's tables (published_torsion.h) where there are any.
void write_torsion_files(const std::filesystem::path& directory, const Scene& scene,
                         const TorsionReport& report);

/// The names of all files that write_torsion_files may write.
std::vector<std::string> torsion_files();

/// @throws NotFinite naming the first quantity of it that is not finite
void require_finite(const TorsionReport& torsion);

}  // namespace pipelines
