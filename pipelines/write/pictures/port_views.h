/// From where a body's ports are looked at, and what is seen of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/write/pictures/port_body.h"
#include "pipelines/write/pictures/port_visibility.h"

class vtkRenderer;

namespace pipelines {

struct PortView {
  std::string caption;
  View view;
  bool cut = false;  ///< the half body is shown
};

/// All views that are worth a try. Long bodies lie with z to the right; others stand with y upwards.
/// @param bounds  x, y, z from and to
std::vector<PortView> possible_views(const double* bounds, const std::optional<CutPlane>& cut);

/// Adds what the view shows.
/// @param ids  in flat colours that tell the ports, else as shown
void add_body(vtkRenderer* renderer, const PortBody& body, const PortView& view, bool ids);

/// What the view shows, as large as it is.
Frame frame_of(const PortBody& body, const PortView& view);

/// What is seen of the ports in a picture of the frame, which has its size.
/// @return one entry per port; empty if this machine cannot draw
std::vector<SeenPort> see_ports(const PortBody& body, const PortView& view, const Frame& frame, int width,
                                int height);

/// One view, or two if one does not show every port well; the views that show most, earlier ones preferred.
/// Empty if this machine cannot draw.
std::vector<PortView> choose_views(const PortBody& body, const std::vector<PortView>& possible);

}  // namespace pipelines
