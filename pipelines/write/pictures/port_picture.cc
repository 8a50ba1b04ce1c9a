#include "pipelines/write/pictures/port_picture.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/write/drawing/label_rows.h"
#include "pipelines/write/drawing/offscreen_window.h"
#include "pipelines/write/drawing/picture_lines.h"
#include "pipelines/write/drawing/picture_parts.h"
#include "pipelines/write/pictures/port_views.h"

namespace pipelines {
namespace {

// Pixels.
constexpr int full_width = 1600, heading = 70, margin = 40, row = 30, leader = 34, strip = 104, font = 22;
constexpr double swatch = 16, space = 8;

/// A view in its part of the picture: a strip with triad and scale, a row of labels, the body, a row of
/// labels.
struct Panel {
  PortView view;
  Frame frame;                                      ///< frame of the part above the strip
  int left = 0, bottom = 0, width = 0, height = 0;  ///< without the strip below
  double m_per_pixel = 0;
  std::vector<SeenPort> seen;
};

Panel make_panel(const PortBody& body, const PortView& view, int panel_width, int highest) {
  Panel panel;
  panel.view = view;
  panel.frame = frame_of(body, view);
  panel.width = panel_width;
  const int rows = 2 * (row + leader);
  panel.m_per_pixel = std::max(2 * panel.frame.half_width / (panel_width - 2 * margin),
                               2 * panel.frame.half_height / (highest - rows));
  panel.height = rows + int(std::ceil(2 * panel.frame.half_height / panel.m_per_pixel));
  panel.frame.half_width = 0.5 * panel.m_per_pixel * panel_width;
  panel.frame.half_height = 0.5 * panel.m_per_pixel * panel.height;
  return panel;
}

std::vector<Pixel> disc(double x, double y, double radius) {
  std::vector<Pixel> corners;
  for (int i = 0; i < 24; ++i)
    corners.push_back({x + radius * std::cos(i * pi / 12), y + radius * std::sin(i * pi / 12)});
  return corners;
}

/// The labels of some ports of the panel.
void add_labels(vtkRenderer* renderer, const Panel& panel, const std::vector<std::string>& names,
                const std::vector<std::size_t>& ports) {
  std::vector<vtkTextActor*> texts;
  std::vector<LabelRequest> requests;
  for (const std::size_t p : ports) {
    texts.push_back(add_words(renderer, names[p], font, 0, 0));
    double box[4];
    texts.back()->GetBoundingBox(renderer, box);
    requests.push_back({panel.seen[p].x, panel.seen[p].y, swatch + space + box[1] - box[0]});
  }
  const LabelRows rows{0.5 * margin, panel.width - 0.5 * margin, double(row), double(panel.height - row),
                       2.5 * space};
  const auto places = place_labels(requests, rows);
  Drawing leaders;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const auto& place = places[i];
    const double bottom = place.above ? panel.height - row + 4 : 4;
    const Colour colour = port_colour(ports[i]);
    texts[i]->GetPositionCoordinate()->SetValue(place.left + swatch + space, bottom);
    Drawing square;
    square.area({{place.left, bottom},
                 {place.left + swatch, bottom},
                 {place.left + swatch, bottom + swatch},
                 {place.left, bottom + swatch}});
    square.put(renderer, colour, 1);
    leaders.line(requests[i].anchor_x, requests[i].anchor_y, place.left + 0.5 * requests[i].width,
                 place.above ? rows.above_y : rows.below_y);
    leaders.area(disc(requests[i].anchor_x, requests[i].anchor_y, 4));
  }
  leaders.put(renderer, ink, 1.5);
}

/// The scale, and what the panel shows.
void add_scale(vtkRenderer* renderer, const Panel& panel) {
  const double right = add_scale_bar(renderer, strip + 30, 28, 0.16 * panel.width, panel.m_per_pixel, font);
  add_words(renderer, panel.view.caption, font, right + 40, 21);
}

/// Shows each port in the first view that shows it nearly as well as any.
std::vector<std::vector<std::size_t>> share_out(const std::vector<Panel>& panels, std::size_t n_ports) {
  std::vector<std::vector<std::size_t>> ports(panels.size());
  for (std::size_t p = 0; p < n_ports; ++p) {
    std::size_t most = 0;
    for (const auto& panel : panels) most = std::max(most, panel.seen[p].n_pixels);
    if (most == 0) continue;
    std::size_t i = 0;
    while (double(panels[i].seen[p].n_pixels) < 0.5 * double(most)) ++i;
    ports[i].push_back(p);
  }
  return ports;
}

}  // namespace

std::optional<CutPlane> cut_through_bores(const std::vector<meshes::Port>& ports) {
  std::optional<CutPlane> cut;
  double furthest = 1e-6;
  for (const auto& a : ports)
    for (const auto& b : ports) {
      if (a.kind != meshes::Port::Kind::bore || b.kind != meshes::Port::Kind::bore) continue;
      if (!cut) cut = CutPlane{{a.axis_x_m, a.axis_y_m, 0}, {-1, 0, 0}};
      const double x = b.axis_x_m - a.axis_x_m, y = b.axis_y_m - a.axis_y_m, distance = std::hypot(x, y);
      if (distance <= furthest || x < 0) continue;
      furthest = distance;
      cut = CutPlane{{a.axis_x_m, a.axis_y_m, 0}, {-y / distance, x / distance, 0}};
    }
  return cut;
}

bool write_port_picture(const std::filesystem::path& vtu, const std::string& title,
                        const std::filesystem::path& png, const std::optional<CutPlane>& cut) {
  if (!make_offscreen_window()) return false;
  const PortBody body = read_port_body(vtu, cut);
  const double* bounds = body.whole.surface->GetBounds();
  const auto views = choose_views(body, possible_views(bounds, cut));
  const bool side_by_side = views.size() > 1 && !is_long(bounds);

  const int width = views.size() > 1 || is_long(bounds) ? full_width : full_width * 3 / 4;
  std::vector<Panel> panels;
  int height = heading, x = 0, tallest = 0;
  for (const auto& view : views) {
    panels.push_back(make_panel(body, view, side_by_side ? width / int(views.size()) : width,
                                side_by_side      ? 900
                                : is_long(bounds) ? 500
                                                  : 800));
    tallest = std::max(tallest, panels.back().height);
  }
  for (auto& panel : panels) {
    if (side_by_side) {
      panel.frame.half_height *= double(tallest) / panel.height;
      panel.height = tallest;
      panel.left = x;
      x += panel.width;
    } else {
      height += panel.height + strip;
    }
    panel.seen = see_ports(body, panel.view, panel.frame, panel.width, panel.height);
  }
  if (side_by_side) height += tallest + strip;

  const auto window = make_offscreen_window();
  window->SetSize(width, height);
  window->SetMultiSamples(4);
  const auto part = [&](double left, double bottom, double wide, double high) {
    return add_renderer(window.get(), left / width, bottom / height, (left + wide) / width,
                        (bottom + high) / height);
  };
  part(0, 0, width, height);
  add_text(part(0, height - heading, width, heading), title, font * 4 / 3, 0.02, 0.35);
  const auto ports = share_out(panels, body.ports.size());
  int top = height - heading;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const auto& panel = panels[i];
    const int bottom = top - panel.height;
    auto* renderer = part(panel.left, bottom, panel.width, panel.height);
    add_body(renderer, body, panel.view, false);
    look(renderer, panel.view.view, panel.frame, double(panel.width) / panel.height,
         4 * panel.frame.half_depth);
    add_labels(renderer, panel, body.ports, ports[i]);
    auto* foot = part(panel.left, bottom - strip, panel.width, strip);
    add_scale(foot, panel);
    add_triad(part(panel.left + 10, bottom - strip, strip, strip), renderer);
    if (!side_by_side) top = bottom - strip;
  }
  write_png(window.get(), png);
  return true;
}

}  // namespace pipelines
