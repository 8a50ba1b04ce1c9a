/// From a load history to stress zones in the shaft: the stages tied together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fem/body.h"
#include "fem/unit_responses.h"
#include "kinetics/load_history.h"
#include "meshes/body_mesh.h"
#include "pipelines/diagrams.h"
#include "pipelines/distribute.h"
#include "pipelines/scene.h"
#include "pipelines/stage_clock.h"
#include "pipelines/superposition.h"
#include "pipelines/zones.h"

namespace pipelines {

/// Parts of the error of a stress at one place that a run can tell by itself [Pa], each an estimate of size,
/// not a bound.
struct StressErrors {
  double time_sampling = 0;  ///< what a parabola through the neighbouring instants adds to the largest one
  double pressure_harmonics = 0;  ///< what the highest harmonic of the seat pressures contributes
  double discretisation = 0;      ///< recovered stress against the plain mean of the cells' own stresses
  double linear_solver = 0;       ///< relative residual times the stress
};

/// One headline stress: where, when, how much.
struct Peak {
  std::size_t node = 0;
  std::array<double, 3> position_m{};
  double value_Pa = 0;
  std::int32_t instant = 0;
  Stress stress_Pa{};
  std::string feature;
  Place place = Place::interior;
  double safety = 0;                 ///< yield strength / von Mises
  std::vector<double> effect_share;  ///< in the order of ChannelHistory::effects
  StressErrors errors;
};

struct ShaftAnalysis {
  meshes::BodyMesh mesh;
  fem::MassProperties masses;
  BodyLoads loads;
  fem::UnitResponses responses;
  bool responses_reused = false;  ///< taken from an earlier run
  Closure closure;
  NodePlaces places;
  std::vector<SharpCorner> sharp_corners;
  Envelope envelope;
  Zones zones;
  Peak peak;                       ///< largest von Mises stress outside the exclusion distances
  std::size_t principal_node = 0;  ///< largest principal stress, likewise
  Diagrams diagrams;
};

/// Where a run keeps its files and what it may use.
struct RunOptions {
  std::filesystem::path directory;
  int n_threads = 0;   ///< 0: all cores
  bool fresh = false;  ///< do not reuse unit responses of an earlier run
};

/// Meshes, distributes, solves, superposes. Writes mesh.msh and unit_responses.h5 into `directory`, nothing
/// else.
/// @throws std::runtime_error if mesh or solve fails, or if the loads do not close to 1e-9 on the mesh
ShaftAnalysis analyse_shaft(const Scene& scene, const kinetics::LoadHistory& history,
                            const RunOptions& options, StageClock& clock);

/// The channels that the scene's effects feed, without a finite-element model: the mass is estimated from the
/// cylinders.
std::vector<Channel> planned_channels(const Scene& scene, const kinetics::LoadHistory& history,
                                      const meshes::BodyMesh& mesh);

/// The re-entrant corners that the geometry leaves sharp, with an exclusion distance of a tenth of the
/// thinner diameter.
std::vector<SharpCorner> sharp_corners(const meshes::Shaft& shaft);

/// What fem needs of a mesh.
fem::Body to_fem_body(const meshes::BodyMesh& mesh, const fem::Material& material);

}  // namespace pipelines
