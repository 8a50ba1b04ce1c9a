/// The part of a body's surface that a page shows: all of it, one half of a body that is its own mirror
/// image, or the corners of its faces alone where it is large.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace pipelines {

struct PageSurface {
  std::vector<std::int32_t> nodes;  ///< of the body, ascending
  std::size_t nodes_per_face = 0;   ///< 3, 4, 6 or 9, in the order of VTK
  /// Positions in `nodes`; beyond them those of the images. Face after face.
  std::vector<std::uint32_t> faces;
  std::size_t n_doubled = 0;  ///< the first faces, which have an image that is not listed
  int mirror_axis = -1;       ///< 0, 1, 2: across the plane where that coordinate is `mirror_at_m`; -1: none
  double mirror_at_m = 0;
  bool has_corners_only = false;  ///< of faces that have nodes between them

  std::size_t n_faces() const { return nodes_per_face == 0 ? 0 : faces.size() / nodes_per_face; }
};

/// @param most_nodes  above it the corners alone are kept
PageSurface page_surface(const fem::Nodes& nodes, const fem::MirrorImages& images, std::size_t most_nodes);

}  // namespace pipelines
