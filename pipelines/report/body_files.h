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
  explicit BodyFiles(const std::filesystem::path& directory) : target_(directory / "mesh.msh") {}

  /// Where the mesh is written until then. The body's directory is made with the first one: a model without a
  /// mesh needs none.
  const std::filesystem::path& mesh() {
    if (!mesh_) mesh_ = std::make_shared<AtomicFile>(target_);
    return mesh_->temporary();
  }

  /// The mesh waits for its name, which it gets together with the other results (write_body_results).
  void finish(BodyAnalysis& analysis, MeshedBody& meshed) {
    analysis.mesh.file = meshed.mesh.file = meshed.body.mesh = mesh();
    analysis.mesh_file = mesh_;
  }

private:
  std::filesystem::path target_;
  std::shared_ptr<AtomicFile> mesh_;
};

}  // namespace pipelines
