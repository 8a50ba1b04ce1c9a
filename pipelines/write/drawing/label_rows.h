/// Where the labels of a picture go: in a row above or below what they name. Pixels, y upwards.
#pragma once

#include <vector>

namespace pipelines {

/// What a label names, and how wide it is.
struct LabelRequest {
  double anchor_x = 0, anchor_y = 0, width = 0;
};

struct LabelPlace {
  bool above = false;
  double left = 0;
};

/// The two rows and their ends.
struct LabelRows {
  double left = 0, right = 0;       ///< ends of both rows
  double below_y = 0, above_y = 0;  ///< where leaders meet the rows
  double gap = 0;                   ///< between neighbours
};

/// Labels that do not overlap as long as the rows are long enough, each in the row and near the place that
/// make the leaders short and keep them from crossing. Rows too short: labels overlap evenly.
std::vector<LabelPlace> place_labels(const std::vector<LabelRequest>& requests, const LabelRows& rows);

}  // namespace pipelines
