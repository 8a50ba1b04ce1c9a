/// The result directory of a run: every file of design, written under a temporary name and renamed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Makes the file of a mesh with its groups (.msh 4.1).
/// @throws FileError if the disk does not take it, meshes::MeshRefused if gmsh cannot open it
void write_mesh(const std::filesystem::path& file, const meshes::BodyMesh& mesh);

/// Writes into `directory`: mesh.msh of a solid; envelope.vtu, cycle.pvd with cycle_*.vtu, zones.csv,
/// zone_tree.csv; hot_spots.csv for a body with weld toes; diagrams.csv, torsion.csv, torsion_cycle.csv for a
/// parametric shaft or drum; element_torques.csv, start_up.csv for a shaft of a drive train
/// (shaft_torsion_report.h).
/// @param n_pieces  pieces of the envelope, one for each MPI rank: with several of them envelope.pvtu and
///                  envelope_<rank>.vtu stand for envelope.vtu
/// @param n_threads  that format and compress; the bytes are the same for any number
void write_body_results(const std::filesystem::path& directory, const Scene& scene,
                        const kinetics::LoadHistory& loads, const Judged& analysis, int n_pieces = 1,
                        int n_threads = 1);

}  // namespace pipelines
