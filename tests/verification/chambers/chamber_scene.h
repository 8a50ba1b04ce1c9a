/// Vibratory mills around chambers of any shape, as scenes.
#pragma once

#include <random>

#include "meshes/chamber/chamber_geometry.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/search/loop/scene_run.h"

namespace chambers {

/// The laboratory mill's machine, scaled to the chamber: charge, eccentricity and springs follow its size,
/// its masses come from the mesh, its attitude is held by the guide. The chamber is the scene's only body.
/// @param directory  for the text of the scene
pipelines::Scene scene_around(const meshes::Chamber& chamber, const std::filesystem::path& directory);

/// A chamber with few cells: thick walls, one or two webs, two feet; otherwise as the mesher's own random
/// ones.
meshes::Chamber small_random_chamber(std::mt19937& random);

/// One web, two feet, a wall of a tenth of the radius.
meshes::Chamber small_chamber();

pipelines::SceneRun run(const pipelines::Scene& scene, const pipelines::RequestedAccuracy& accuracy = {});

}  // namespace chambers
