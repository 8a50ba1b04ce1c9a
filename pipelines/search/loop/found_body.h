/// What a search has found of a body, for other versions of its scene.
#pragma once

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

struct FoundBody {
  BodyScene body;             ///< with the mesh that was found
  int added_harmonics = 0;    ///< of seat pressure, beside those of the scene as read
  int instants_per_turn = 0;  ///< 0: the search asked for no more than the scene has

  /// @param as_read  before the search
  /// @param found    after it
  FoundBody(const Scene& as_read, const Scene& found, std::size_t i_body);

  /// Puts mesh, and the harmonics, felt seats and instants that were added, into another version of the
  /// scene.
  void enter(Scene& scene, std::size_t i_body) const;
};

}  // namespace pipelines
