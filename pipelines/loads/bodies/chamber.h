/// The chamber of the vibratory mill, with the exciter's housing.
#pragma once

#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_mill.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/load_maker.h"

namespace pipelines {

/// The couple that holds the chamber's attitude with `pitch` off, as an effect.
inline constexpr const char* pitch_guide = "pitch_guide";

/// What the chamber's loads depend on beside the load stage.
struct ChamberLoading {
  std::vector<std::string> effects;     ///< effects of the scene
  std::vector<AttachedMass> structure;  ///< move with the chamber: covers, differences to the mesh
  std::vector<AttachedMass> exciter;    ///< move with the exciter's housing
  PitchGuide guide = PitchGuide::body;
};

/// Loads in axes that translate with the chamber; positions from E' (coupling of loads and bodies, section
/// 3).
///
/// Ports: housing_bore (+B; mx, my for what is not symmetric in z), spring_foot_1.. (f_i), inner_wall (F_w
/// through the axis C and the friction torque r e(chi) x F_w), volume.structure and volume.exciter (gravity,
/// -s'', -theta'' z x p), attached masses at their ports.
/// @param body  region "structure", and "exciter" unless that is an attached mass
/// @throws StageRefused if a port is missing or the history lacks a resultant; std::out_of_range if
/// a region is
BodyLoads distribute_chamber(const kinetics::LoadHistory& loads, const kinetics::VibratoryMill& mill,
                             const LoadedBody& body, const ChamberLoading& loading);

const LoadMaker& chamber_loads();

}  // namespace pipelines
