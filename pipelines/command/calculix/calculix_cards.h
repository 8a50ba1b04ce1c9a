/// Loads over the cycle as input cards of CalculiX (and Abaqus), for who has another finite-element code.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"

namespace pipelines {

/// The text of the two files.
struct CalculixCards {
  std::string amplitudes;  ///< model data, before the first *STEP
  std::string loads;       ///< history data, within a *STEP
  /// Node sets that the user's model has to define, each one node or spread alike.
  std::vector<std::string> node_sets;
};

/// One *AMPLITUDE per load that is not zero throughout, in N or N m over seconds, of loads that repeat closed
/// by the first value one period later; and one *CLOAD per load on the node set N_<ROLE>: fx and fy on
/// degrees of freedom 1 and 2, a torque about z on degree of freedom 3 of the node set N_<ROLE>_ROT, which in
/// CalculiX is the ROT NODE of the port's *RIGID BODY (in Abaqus: degree of freedom 6 of the reference node).
/// Loads of a load table that are no planar resultant (fz, mx, my) come along on 3 of N_<PORT> and 1, 2 of
/// N_<PORT>_ROT. A card's load acts on EVERY node of its set: give a reference node.
/// @param repeats  false: a run-up
/// @throws StageRefused if two loads would get the same name
CalculixCards calculix_cards(const kinetics::LoadHistory& loads, bool repeats);

/// `<prefix>_amplitudes.inp` and `<prefix>_loads.inp`; none without a prefix.
std::vector<std::filesystem::path> calculix_card_files(const std::filesystem::path& prefix);

/// Whether a file begins as those that write_calculix_cards leaves.
bool is_calculix_cards(const std::filesystem::path& file);

/// Writes both files.
/// @throws OptionError if a file that is there is none of these
void write_calculix_cards(const std::filesystem::path& prefix, const kinetics::LoadHistory& loads,
                          bool repeats);

}  // namespace pipelines
