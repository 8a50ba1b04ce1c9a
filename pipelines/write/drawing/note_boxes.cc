#include "pipelines/write/drawing/note_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipelines/base/common/constants.h"

namespace pipelines {
namespace {

bool overlap(const NoteBox& a, const NoteBox& b, double gap) {
  return a.left < b.left + b.width + gap && b.left < a.left + a.width + gap &&
         a.bottom < b.bottom + b.height + gap && b.bottom < a.bottom + a.height + gap;
}

NoteBox inside(NoteBox box, double window_width, double window_height) {
  box.left = std::clamp(box.left, 0.0, std::max(0.0, window_width - box.width));
  box.bottom = std::clamp(box.bottom, 0.0, std::max(0.0, window_height - box.height));
  return box;
}

}  // namespace

std::vector<NoteBox> moved_apart(const std::vector<NoteBox>& boxes, double gap, double window_width,
                                 double window_height) {
  constexpr int most_rings = 40, n_directions = 16;
  std::vector<NoteBox> placed;
  const auto is_free = [&](const NoteBox& box) {
    return std::none_of(placed.begin(), placed.end(),
                        [&](const auto& other) { return overlap(box, other, gap); });
  };
  for (const auto& box : boxes) {
    auto best = inside(box, window_width, window_height);
    const double step = 0.5 * box.height;
    for (int ring = 1; ring <= most_rings && !is_free(best); ++ring)
      for (int d = 0; d < n_directions && !is_free(best); ++d) {
        const double angle = 2 * pi * d / n_directions;
        NoteBox tried = box;
        tried.left += ring * step * std::cos(angle);
        tried.bottom += ring * step * std::sin(angle);
        tried = inside(tried, window_width, window_height);
        if (is_free(tried)) best = tried;
      }
    placed.push_back(best);
  }
  return placed;
}

}  // namespace pipelines
