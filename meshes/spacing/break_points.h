/// Points that a one-dimensional distribution of cells has to hit, none of them closer than a given distance.
#pragma once

#include <string>
#include <vector>

namespace meshes {

/// Places of cell boundaries along a line, or around a closed one of length `period_m` (0: not closed).
/// Lengths in m.
class BreakPoints {
public:
  explicit BreakPoints(double closest_m, double period_m = 0);

  /// An edge of the geometry. One that coincides with an earlier one is that one.
  /// @param what names it in messages
  /// @throws GeometryRefused if it comes closer than closest_m to another without meeting it
  void add(double at_m, const std::string& what);

  /// A point that may move: the break point within closest_m if there is one, else a new one.
  /// @return where it is
  double add_or_snap(double at_m);

  /// Ascending; from 0 to below the period if closed.
  std::vector<double> sorted() const;

private:
  struct BreakPoint {
    double at_m = 0;
    std::string what;
  };
  double distance_m(double a_m, double b_m) const;
  const BreakPoint* nearest(double at_m) const;
  bool meets(const BreakPoint& point, double at_m) const;
  void insert(double at_m, const std::string& what);

  double closest_m_, period_m_;
  std::vector<BreakPoint> points_;
};

}  // namespace meshes
