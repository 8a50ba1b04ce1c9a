/// Where the boxes of words go that are written beside places of a picture. Pixels, y upwards.
#pragma once

#include <vector>

namespace pipelines {

struct NoteBox {
  double left = 0, bottom = 0, width = 0, height = 0;
};

/// Boxes moved apart, the first ones first: each stays where it is, or goes to the nearest free spot of a
/// ring of spots around it, within the window. Without a free spot it stays.
/// @param gap  between neighbours
std::vector<NoteBox> moved_apart(const std::vector<NoteBox>& boxes, double gap, double window_width,
                                 double window_height);

}  // namespace pipelines
