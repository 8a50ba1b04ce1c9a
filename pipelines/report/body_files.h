/// The mesh file of a body while a run looks for its mesh.
#pragma once

#include <filesystem>
#include <memory>

#include "pipelines/analysis/body_analysis.h"
#include "pipelines/files/atomic_file.h"

namespace pipelines {

/// What becomes the mesh of one body.
class BodyFiles {
public:
  explicit BodyFiles(const std::filesystem::path& directory)
      : directory_(directory), mesh_(std::make_unique<AtomicFile>(directory / "mesh.msh")) {}

  const std::filesystem::path& mesh() const { return mesh_->temporary(); }

  /// The mesh gets its name.
  void finish(BodyAnalysis& analysis, MeshedBody& meshed) {
    mesh_->commit();
    analysis.mesh.file = meshed.mesh.file = meshed.body.mesh = directory_ / "mesh.msh";
  }

private:
  std::filesystem::path directory_;
  std::unique_ptr<AtomicFile> mesh_;
};

}  // namespace pipelines
