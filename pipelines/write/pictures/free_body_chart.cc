#include "pipelines/write/pictures/free_body_chart.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/write/drawing/chart.h"
#include "pipelines/write/machines/free_body_report.h"

namespace pipelines {
namespace {

using Eigen::Vector2d;

/// The largest of 1, 2 and 5 times a power of ten that is not larger.
double round_below(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  return power * (value >= 5 * power ? 5 : value >= 2 * power ? 2 : 1);
}

double largest_force_N(const kinetics::FreeBody& body) {
  double largest = 0;
  for (const auto& load : body.loads)
    largest = std::max(largest, load.force_N.matrix().colwise().norm().maxCoeff());
  return largest;
}

ChartCurve line(const std::string& name, const std::vector<Vector2d>& points_mm) {
  ChartCurve curve;
  curve.name = name;
  curve.has_marks = false;
  for (const auto& p : points_mm) {
    curve.x.push_back(p.x());
    curve.y.push_back(p.y());
  }
  return curve;
}

/// @param head_mm  at most; a third of short arrows
ChartCurve arrow(const std::string& name, const Vector2d& from_mm, const Vector2d& along_mm, double head_mm) {
  const double length_mm = along_mm.norm();
  const Vector2d to = from_mm + along_mm;
  const Vector2d back = std::min(head_mm, length_mm / 3) / length_mm * along_mm;
  const Vector2d side(-0.4 * back.y(), 0.4 * back.x());
  return line(name, {from_mm, to, to - back + side, to, to - back - side});
}

/// Millimetres from the chamber's centre at rest; the pivot at rest is on the shaft's axis.
class Drawing {
public:
  Drawing(const Scene& scene, const kinetics::FreeBody& body)
      : body_(body),
        centre_m_(scene.vibratory_mill().chamber_centre_m),
        radius_m_(chamber_radius_m(scene).value_or(0)) {
    for (Eigen::Index i = 0; i < body.time_s.size(); ++i) {
      for (const auto& load : body.loads) box_.extend(at_mm(load.at_m.col(i).matrix(), i));
      for (const auto& point : chamber_mm(i)) box_.extend(point);
    }
    const double largest_kN = 1e-3 * largest_force_N(body), extent_mm = box_.diagonal().norm();
    if (largest_kN > 0 && extent_mm > 0) mm_per_kN_ = round_below(extent_mm / largest_kN);
    for (Eigen::Index i = 0; i < body.time_s.size(); ++i)
      for (const auto& load : body.loads)
        box_.extend(Vector2d(at_mm(load.at_m.col(i).matrix(), i) + along_mm(load, i)));
  }
  double mm_per_kN() const { return mm_per_kN_; }
  Vector2d at_mm(const Vector2d& from_pivot_m, Eigen::Index i) const {
    return 1e3 * (body_.pivot_m.col(i).matrix() + from_pivot_m - centre_m_);
  }
  Vector2d along_mm(const kinetics::FreeBodyLoad& load, Eigen::Index i) const {
    return 1e-3 * mm_per_kN_ * load.force_N.col(i).matrix();
  }
  /// The wall as a closed line; nothing if its radius is not known.
  std::vector<Vector2d> chamber_mm(Eigen::Index i) const {
    std::vector<Vector2d> circle;
    constexpr int n = 120;
    for (int k = 0; k <= n && radius_m_ > 0; ++k) {
      const double angle = 2 * pi * (k % n) / n;
      circle.push_back(at_mm(centre_m_ + radius_m_ * Vector2d(std::cos(angle), std::sin(angle)), i));
    }
    return circle;
  }
  /// Window that holds all instants.
  ChartWindow window() const {
    const double margin_mm = 0.03 * box_.diagonal().norm();
    return {{box_.min().x() - margin_mm, box_.max().x() + margin_mm},
            {box_.min().y() - margin_mm, box_.max().y() + margin_mm}};
  }
  double head_mm() const { return 0.025 * box_.diagonal().norm(); }

private:
  const kinetics::FreeBody& body_;
  Vector2d centre_m_;
  double radius_m_, mm_per_kN_ = 1;
  Eigen::AlignedBox2d box_;
};

}  // namespace

bool draw_free_body(const Scene& scene, const kinetics::FreeBody& body, Eigen::Index instant,
                    const std::filesystem::path& file) {
  const Drawing drawing(scene, body);
  LineChart chart;
  chart.x.title = "x from the chamber's centre at rest [mm]";
  chart.y.title = "y [mm]";
  chart.window = drawing.window();
  if (const auto chamber_mm = drawing.chamber_mm(instant); !chamber_mm.empty())
    chart.curves.push_back(line("wall of the chamber", chamber_mm));
  for (const auto& load : body.loads) {
    const double force_N = load.force_N.col(instant).matrix().norm();
    if (force_N == 0) continue;
    chart.curves.push_back(arrow(fmt::format("{}: {:.4g} N", load.name, force_N),
                                 drawing.at_mm(load.at_m.col(instant).matrix(), instant),
                                 drawing.along_mm(load, instant), drawing.head_mm()));
  }
  const double turns = body.phi_rad[instant] / (2 * pi);
  chart.title = fmt::format("{}: free body of the chamber at {:.4g} deg; {:g} mm for 1 kN", scene.title,
                            360 * (turns - std::floor(turns)), drawing.mm_per_kN());
  return write_chart(chart, file);
}

}  // namespace pipelines
