/// Fatigue of a shaft's fillets by DIN 743, from nominal stresses of its sections: a second opinion.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/fatigue/din_743.h"
#include "pipelines/base/fatigue/fatigue_material.h"
#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// A fillet by DIN 743. Nominal stresses are those of the thinner section next to it, about its own axis.
struct NominalFatigue {
  std::string fillet;     ///< the feature, "fillet A/B"
  double z_m = 0;         ///< place of the section
  double diameter_m = 0;  ///< diameter of the section
  DinLoad load;           ///< over the cycle (nominal_load)
  DinTriple shape_factor;
  DinSafety safety;        ///< DIN asks for 1.2
  double error_share = 0;  ///< error of the local amplitude, and so of the shape factor; infinite: not known
  /// Safety against fatigue, with the local amplitude larger by that error; none: not known.
  std::optional<double> least_safety;
};

/// Local amplitude of von Mises stress in a fillet.
struct LocalAmplitude {
  double value_Pa = -1;  ///< negative: not known
  double error_share = std::numeric_limits<double>::infinity();
};

/// The section of a segment nearest to a place; null: the segment has none.
const SectionResult* nearest_section(const Diagrams& diagrams, const std::string& segment, double z_m);

/// Nominal stresses of a solid round section over the cycle, from its resultants by statics about its own
/// axis. The amplitude of bending is that in the direction in which it changes most. Its mean is the vector
/// of the middles in two directions at right angles, the largest for any such pair: static bending counts
/// whole, whichever way it lies to what changes, as if both met in one fibre. That is on the safe side.
DinLoad nominal_load(const SectionResult& section);

/// Shape factors that make the local stress amplitude the program's own: published fits
/// (fem/models/beam/fillet_factors.h) share it out among tension, bending and torsion.
/// @param local_Pa    amplitude of von Mises stress in the fillet, >= 0
/// @param nominal_Pa  amplitudes
DinTriple own_shape_factor(const DinTriple& published, const DinTriple& nominal_Pa, double local_Pa);

/// Related gradient of a shoulder: 2.3 (1 + phi) / r in tension and bending, 1.15 / r in torsion, with
/// phi = 1 / (4 sqrt(t / r) + 2), t = (D - d) / 2, where d/D > 0.67, else 0. Source: DIN 743-2, table 2.
/// @param small_m, large_m  diameters
DinTriple din_shoulder_gradient_1_m(double small_m, double large_m, double fillet_m);

/// Whether DIN 743 is for it: rolled and forged steel.
bool is_din_steel(const GroupConstants& group);

/// Whether there is a fillet between solid segments: the only notch that is taken.
bool has_din_fillet(const meshes::Shaft& shaft);

/// Judges every fillet between solid segments of a parametric shaft, least safety first; none of other
/// bodies.
/// @param loads               with the channels of the analysis
/// @param local_amplitude  amplitude of a fillet, by feature
std::vector<NominalFatigue> din_743_of_fillets(
    const Judged& analysis, const ChannelHistory& loads,
    const std::function<LocalAmplitude(const std::string&)>& local_amplitude);

}  // namespace pipelines
