#include "meshes/spacing/break_points.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "meshes/values/refused.h"

namespace meshes {

namespace {

const double same_share = 1e-6;  // share of the closest distance that rounding may blur

}  // namespace

BreakPoints::BreakPoints(double closest_m, double period_m) : closest_m_(closest_m), period_m_(period_m) {}

double BreakPoints::distance_m(double a_m, double b_m) const {
  return std::abs(period_m_ > 0 ? std::remainder(a_m - b_m, period_m_) : a_m - b_m);
}

const BreakPoints::BreakPoint* BreakPoints::nearest(double at_m) const {
  const auto closer = [&](const BreakPoint& a, const BreakPoint& b) {
    return distance_m(a.at_m, at_m) < distance_m(b.at_m, at_m);
  };
  return points_.empty() ? nullptr : &*std::min_element(points_.begin(), points_.end(), closer);
}

bool BreakPoints::meets(const BreakPoint& point, double at_m) const {
  return distance_m(point.at_m, at_m) <= same_share * closest_m_;
}

void BreakPoints::insert(double at_m, const std::string& what) {
  if (period_m_ > 0) {
    at_m = std::fmod(at_m, period_m_);
    if (at_m < 0) at_m += period_m_;
    if (at_m >= period_m_) at_m = 0;
  }
  points_.push_back({at_m, what});
}

void BreakPoints::add(double at_m, const std::string& what) {
  const BreakPoint* near = nearest(at_m);
  if (near && meets(*near, at_m)) return;
  if (near && distance_m(near->at_m, at_m) < closest_m_) {
    std::ostringstream text;
    text << "chamber: " << near->what << " and " << what << " are " << distance_m(near->at_m, at_m) * 1e3
         << " mm apart; at least " << closest_m_ * 1e3
         << " mm can be meshed: move one of them, or make them coincide";
    throw GeometryRefused(text.str());
  }
  insert(at_m, what);
}

double BreakPoints::add_or_snap(double at_m) {
  const BreakPoint* near = nearest(at_m);
  if (near && distance_m(near->at_m, at_m) < closest_m_) return near->at_m;
  insert(at_m, "a path of stresses");
  return points_.back().at_m;
}

std::vector<double> BreakPoints::sorted() const {
  std::vector<double> result;
  for (const BreakPoint& point : points_) result.push_back(point.at_m);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace meshes
