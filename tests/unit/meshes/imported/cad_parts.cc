#include "tests/unit/meshes/imported/cad_parts.h"

#include <gmsh.h>

#include <cmath>
#include <utility>

#include "meshes/values/constants.h"

namespace {

namespace occ = gmsh::model::occ;
using Solids = gmsh::vectorpair;
using meshes::pi;

Solids fused(const Solids& a, const Solids& b) {
  Solids result;
  std::vector<Solids> map;
  occ::fuse(a, b, result, map);
  return result;
}

Solids without(const Solids& a, const Solids& b) {
  Solids result;
  std::vector<Solids> map;
  occ::cut(a, b, result, map);
  return result;
}

Solids block(double x, double y, double z, double dx, double dy, double dz) {
  return {{3, occ::addBox(x, y, z, dx, dy, dz)}};
}

/// Along z from (x, y, z).
Solids rod(double x, double y, double z, double length, double radius) {
  return {{3, occ::addCylinder(x, y, z, 0, 0, length, radius)}};
}

Solids ball(double x, double y, double z, double radius) {
  return {{3, occ::addSphere(x, y, z, radius)}};
}

struct SectionCorner {
  double r, z;
};

/// Turned about z, from corner to corner of its half section.
Solids turned(const std::vector<SectionCorner>& corners, double angle = 2 * pi) {
  std::vector<int> points, lines;
  for (const auto& corner : corners) points.push_back(occ::addPoint(corner.r, 0, corner.z));
  for (std::size_t i = 0; i < points.size(); ++i)
    lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
  Solids all, solids;
  occ::revolve({{2, occ::addPlaneSurface({occ::addWire(lines)})}}, 0, 0, 0, 0, 0, 1, angle, all);
  for (const auto& entity : all)
    if (entity.first == 3) solids.push_back(entity);
  return solids;
}

/// A hole along z from z = top downwards, ended by a drill's tip of that whole angle.
Solids drilled(double x, double y, double top, double radius, double depth, double tip_deg) {
  const double tip = radius / std::tan(tip_deg / 360 * pi);
  auto hole = turned({{0, top + 1}, {radius, top + 1}, {radius, top - depth}, {0, top - depth - tip}});
  occ::translate(hole, x, y, 0);
  return hole;
}

/// What a centre drill takes away at z = top, downwards: pilot hole d1 with a 120 degree tip, 60 degree cone
/// up to d2 (DIN 332-1 form A for d1 = 2, d2 = 4.25: t = 3.9 with the tip's beginning).
std::vector<SectionCorner> centre_drill(double d1, double d2, double t, double top) {
  const double cone = (d2 - d1) / 2 / std::tan(pi / 6);
  return {{0, top - t - d1 / 2 / std::tan(pi / 3)}, {d1 / 2, top - t}, {d1 / 2, top - cone}, {d2 / 2, top}};
}

Solids centre_hole(std::vector<SectionCorner> profile, double top) {
  profile.push_back({profile.back().r, top + 1});
  profile.push_back({0, top + 1});
  return turned(profile);
}

void centre_a() {
  without(rod(0, 0, 0, 60, 10), centre_hole(centre_drill(2, 4.25, 3.9, 60), 60));
}
void centre_b() {  // 120 degree protection cone up to d3 = 6.3
  auto profile = centre_drill(2, 4.25, 4.5, 59.4);
  profile.push_back({3.15, 59.4 + (3.15 - 2.125) / std::tan(pi / 3)});
  without(rod(0, 0, 0, profile.back().z, 10), centre_hole(profile, profile.back().z));
}
void centre_c() {  // recess with a truncated 120 degree cone
  auto profile = centre_drill(2, 4.25, 4.5, 59.2);
  profile.push_back({2.6, 59.2});
  profile.push_back({3.2, 59.55});
  profile.push_back({3.2, 60});
  without(rod(0, 0, 0, 60, 10), centre_hole(profile, 60));
}
void centre_r() {  // the cone is an arc of radius 5, tangent to nothing
  const int p[] = {occ::addPoint(0, 0, 55.2),   occ::addPoint(1, 0, 55.8),   occ::addPoint(1, 0, 57.5),
                   occ::addPoint(2.125, 0, 60), occ::addPoint(2.125, 0, 61), occ::addPoint(0, 0, 61)};
  // Through the pilot's end and the rim, bulging towards the axis.
  const double mx = (1 + 2.125) / 2, mz = (57.5 + 60) / 2, dx = 1.125, dz = 2.5,
               half = std::hypot(dx, dz) / 2;
  const double off = std::sqrt(25 - half * half) / std::hypot(dx, dz);
  const int centre = occ::addPoint(mx - dz * off * -1, 0, mz + dx * off * -1);
  Solids all, hole;
  occ::revolve(
      {{2, occ::addPlaneSurface({occ::addWire(
               {occ::addLine(p[0], p[1]), occ::addLine(p[1], p[2]), occ::addCircleArc(p[2], centre, p[3]),
                occ::addLine(p[3], p[4]), occ::addLine(p[4], p[5]), occ::addLine(p[5], p[0])})})}},
      0, 0, 0, 0, 0, 1, 2 * pi, all);
  for (const auto& entity : all)
    if (entity.first == 3) hole.push_back(entity);
  without(rod(0, 0, 0, 60, 10), hole);
}
void centre_d() {  // DIN 332-2 form D, M6: core hole 5, counterbore 6.4, 60 degree cone up to 9.6
  without(rod(0, 0, 0, 60, 12),
          centre_hole({{0, 38.5}, {2.5, 40}, {2.5, 55}, {3.2, 55.4}, {3.2, 57.2}, {4.8, 60}}, 60));
}
void centre_to_a_point() {
  without(rod(0, 0, 0, 60, 10), turned({{0, 60 - 5 / std::tan(pi / 6)}, {5, 60}, {5, 61}, {0, 61}}));
}
void centres_at_both_ends() {
  auto shaft = fused(rod(0, 0, 0, 80, 8), rod(0, 0, 25, 30, 12));
  shaft = without(shaft, centre_hole(centre_drill(3.15, 6.7, 6, 80), 80));
  auto other = centre_hole(centre_drill(3.15, 6.7, 6, 80), 80);
  occ::rotate(other, 0, 0, 40, 1, 0, 0, pi);
  without(shaft, other);
}
void tip_118() {
  without(block(-15, -15, 0, 30, 30, 25), drilled(0, 0, 25, 4, 12, 118));
}
void tip_90() {
  without(block(-15, -15, 0, 30, 30, 25), drilled(0, 0, 25, 4, 12, 90));
}
void tip_off_the_axis() {
  without(rod(0, 0, 0, 40, 15), drilled(5, 3, 40, 3, 15, 118));
}
void tip_oblique() {
  auto hole = drilled(0, 0, 0, 3, 14, 118);
  occ::rotate(hole, 0, 0, 0, 1, 0, 0, pi / 6);
  occ::translate(hole, 0, -2, 20);
  occ::synchronize();
  auto part = block(-12, -15, 0, 24, 30, 20);
  without(part, hole);
}
void tip_into_a_bore() {  // a cross hole whose tip lies in the wall of a bore
  auto part = without(rod(0, 0, 0, 50, 16), rod(0, 0, -1, 52, 6));
  auto hole = drilled(0, 0, 0, 2.5, 6, 118);
  occ::rotate(hole, 0, 0, 0, 0, 1, 0, pi / 2);
  occ::translate(hole, 16, 0, 25);
  without(part, hole);
}
void stepped_drill() {  // a small drill's hole within a larger one's tip
  without(rod(0, 0, 0, 50, 14), turned({{0, 12}, {2.5, 13.5}, {2.5, 25}, {6, 28.6}, {6, 51}, {0, 51}}));
}
void four_tips() {
  auto plate = block(0, 0, 0, 50, 50, 20);
  for (const double x : {12., 38.})
    for (const double y : {12., 38.}) plate = without(plate, drilled(x, y, 20, 3.4, 10, 118));
}
void pointed_bar() {
  fused(rod(0, 0, 0, 40, 8), {{3, occ::addCone(0, 0, 40, 0, 0, 14, 8, 0)}});
}
void needle() {
  fused(rod(0, 0, 0, 30, 4), {{3, occ::addCone(0, 0, 30, 0, 0, 40, 4, 0)}});
}
/// A cone as CAD programs write it that know B-splines alone; a scaling makes them of all surfaces.
void spline_needle() {
  Solids pencil{{3, occ::addCylinder(0, 0, -10, 0, 0, 10, 10)}}, result;
  std::vector<Solids> map;
  occ::fuse(pencil, {{3, occ::addCone(0, 0, 0, 0, 0, 20, 10, 0)}}, result, map);
  occ::dilate(result, 0, 0, 0, 1, 1, 2);
}
void two_points() {
  fused({{3, occ::addCone(0, 0, 0, 0, 0, -20, 10, 0)}}, {{3, occ::addCone(0, 0, 0, 0, 0, 20, 10, 0)}});
}
void oblique_point() {
  without(Solids{{3, occ::addCone(0, 0, 0, 0, 0, 40, 12, 0)}}, [] {
    auto half = block(-40, -40, -40, 80, 80, 40);
    occ::rotate(half, 0, 0, 0, 0, 1, 0, 0.3);
    return half;
  }());
}
void half_ball_end() {
  fused(rod(0, 0, 0, 40, 8), ball(0, 0, 40, 8));
}
void ball_stud() {
  fused(fused(rod(0, 0, 0, 20, 10), rod(0, 0, 20, 14, 5)), ball(0, 0, 40, 9));
}
void ball_nose_hole() {
  without(block(-15, -15, 0, 30, 30, 30), fused(rod(0, 0, 15, 16, 6), ball(0, 0, 15, 6)));
}
void shallow_dimple() {
  without(block(-15, -15, 0, 30, 30, 12), ball(0, 0, 12 + 18, 19));
}
void arm_boss() {  // the arm is as wide as the boss: its sides are tangent
  auto part = fused(rod(0, 0, 0, 30, 20), block(-80, -20, 5, 80, 40, 20));
  without(part, rod(0, 0, -1, 32, 10));
}
/// Outline of a link between two circles about (0, 0) and (length, 0), and that face drawn out along z.
Solids link(double r1, double r2, double length, double z, double height) {
  const double s = (r1 - r2) / length, c = std::sqrt(1 - s * s);
  const auto at = [&](double x, double r, double side) { return occ::addPoint(x + r * s, side * r * c, z); };
  const int a1 = at(0, r1, 1), b1 = at(length, r2, 1), b2 = at(length, r2, -1), a2 = at(0, r1, -1),
            m1 = occ::addPoint(0, 0, z), m2 = occ::addPoint(length, 0, z), left = occ::addPoint(-r1, 0, z),
            right = occ::addPoint(length + r2, 0, z);
  const int wire =
      occ::addWire({occ::addLine(a1, b1), occ::addCircleArc(b1, m2, right), occ::addCircleArc(right, m2, b2),
                    occ::addLine(b2, a2), occ::addCircleArc(a2, m1, left), occ::addCircleArc(left, m1, a1)});
  Solids all, solids;
  occ::extrude({{2, occ::addPlaneSurface({wire})}}, 0, 0, height, all);
  for (const auto& entity : all)
    if (entity.first == 3) solids.push_back(entity);
  return solids;
}
void connecting_rod() {  // bosses higher than the link, whose sides are tangent to both
  auto part = fused(fused(rod(0, 0, 0, 20, 18), rod(80, 0, 0, 20, 12)), link(18, 12, 80, 6, 8));
  part = without(part, rod(0, 0, -1, 22, 10));
  without(part, rod(80, 0, -1, 22, 6));
}
void tangent_lever() {  // one side of the arm alone is tangent
  auto part = fused(rod(0, 0, 0, 24, 15), block(-60, 3, 4, 60, 12, 12));
  without(part, rod(0, 0, -1, 26, 7));
}
void crank_webs() {  // webs as wide as journal and pin are apart: tangent at both
  auto part = fused(fused(rod(0, 0, 0, 30, 12), rod(30, 0, 42, 20, 12)), link(12, 12, 30, 30, 12));
  without(part, rod(30, 0, 40, 23, 5));
}
void tangent_rib() {  // a rib's flank is tangent to the boss on a plate
  auto part = fused(block(-40, -30, 0, 80, 60, 8), rod(0, 0, 8, 25, 12));
  part = fused(part, block(-36, 6, 8, 36, 6, 14));
  without(part, rod(0, 0, -1, 40, 7));
}
void lying_rod() {  // pressed a tenth into a plate: wedges of 7 degrees
  auto lying = Solids{{3, occ::addCylinder(-20, 0, 17.9, 40, 0, 0, 10)}};
  fused(block(-30, -20, 0, 60, 40, 8), lying);
}
void boss_with_ribs() {
  auto part = fused(block(-40, -40, 0, 80, 80, 8), rod(0, 0, 8, 30, 12));
  for (int i = 0; i < 4; ++i) {
    const int p[] = {occ::addPoint(8, -3, 8), occ::addPoint(36, -3, 8), occ::addPoint(8, -3, 34)};
    Solids all, rib;
    occ::extrude({{2, occ::addPlaneSurface({occ::addWire(
                          {occ::addLine(p[0], p[1]), occ::addLine(p[1], p[2]), occ::addLine(p[2], p[0])})})}},
                 0, 6, 0, all);
    for (const auto& entity : all)
      if (entity.first == 3) rib.push_back(entity);
    occ::rotate(rib, 0, 0, 0, 0, 0, 1, i * pi / 2);
    part = fused(part, rib);
  }
  without(part, rod(0, 0, -1, 41, 6));
}
void runout_fillets() {  // fillets that end in the arm's tangent sides
  auto part = fused(rod(0, 0, 0, 30, 20), block(-70, -14, 0, 70, 28, 12));
  occ::synchronize();
  Solids edges, filleted;
  gmsh::model::getEntitiesInBoundingBox(-20.1, -14.1, 11.9, -10, 14.1, 12.1, edges, 1);
  std::vector<int> curves;
  for (const auto& edge : edges) curves.push_back(edge.second);
  occ::fillet({part.at(0).second}, curves, {4}, filleted);
}
void countersunk() {
  auto plate = block(-30, -20, 0, 60, 40, 10);
  for (const double x : {-15., 15.}) {
    auto hole = turned({{0, -1}, {3.3, -1}, {3.3, 6.7}, {6.6, 10}, {6.6, 11}, {0, 11}});
    occ::translate(hole, x, 0, 0);
    plate = without(plate, hole);
  }
}
void counterbored() {
  auto plate = block(-20, -20, 0, 40, 40, 16);
  without(plate, fused(rod(0, 0, -1, 18, 4.5), rod(0, 0, 8, 9, 7.5)));
}
void sharp_grooves() {  // a thread M20 as plain 60 degree grooves
  std::vector<SectionCorner> corners = {{0, 0}, {10, 0}, {10, 20}};
  for (int i = 0; i < 6; ++i) {
    const double z = 20 + 2.5 * i;
    corners.push_back({8.5, z + 0.9});
    corners.push_back({8.5, z + 1.4});
    corners.push_back({10, z + 2.2});
    corners.push_back({10, z + 2.5});
  }
  corners.push_back({10, 50});
  corners.push_back({0, 50});
  turned(corners);
}
void round_groove() {  // a relief groove of radius 1.2 that comes out tangent to the shoulder
  auto part = fused(rod(0, 0, 0, 30, 10), rod(0, 0, 30, 15, 16));
  without(part, {{3, occ::addTorus(0, 0, 28.8, 10, 1.2)}});
}
void pipe_elbow() {
  const int p[] = {occ::addPoint(0, 0, 0), occ::addPoint(0, 0, 30), occ::addPoint(30, 0, 60),
                   occ::addPoint(60, 0, 60)};
  const int centre = occ::addPoint(30, 0, 30);
  const int wire = occ::addWire(
      {occ::addLine(p[0], p[1]), occ::addCircleArc(p[1], centre, p[2]), occ::addLine(p[2], p[3])});
  const int ring = occ::addPlaneSurface(
      {occ::addWire({occ::addCircle(0, 0, 0, 10)}), occ::addWire({occ::addCircle(0, 0, 0, 7)})});
  Solids pipe;
  occ::addPipe({{2, ring}}, wire, pipe);
  occ::remove({{2, ring}});
}
void swept_along_a_spline() {
  const int spline = occ::addSpline({occ::addPoint(0, 0, 0), occ::addPoint(0, 5, 25),
                                     occ::addPoint(10, 0, 50), occ::addPoint(15, -10, 80)});
  const int disc = occ::addDisk(0, 0, 0, 8, 5);
  Solids bar;
  occ::addPipe({{2, disc}}, occ::addWire({spline}), bar);
  occ::remove({{2, disc}});
}
/// Four arcs, or four straight lines, about the axis at the height z.
int ring_of_four(double r, double z, bool round) {
  std::vector<int> points, curves;
  const int centre = occ::addPoint(0, 0, z);
  for (int i = 0; i < 4; ++i)
    points.push_back(occ::addPoint(r * std::cos((i + 0.5) * pi / 2), r * std::sin((i + 0.5) * pi / 2), z));
  for (int i = 0; i < 4; ++i)
    curves.push_back(round ? occ::addCircleArc(points[i], centre, points[(i + 1) % 4])
                           : occ::addLine(points[i], points[(i + 1) % 4]));
  return occ::addWire(curves);
}
void lofted() {  // from a square to a circle
  Solids solids;
  occ::addThruSections({ring_of_four(17, 0, false), ring_of_four(8, 40, true)}, solids, -1, true, false);
}
void lofted_blade() {
  std::vector<int> wires;
  for (int i = 0; i < 3; ++i) {
    const int disc = occ::addEllipse(0, 0, 0, 14 - 3 * i, 3 - 0.8 * i);
    occ::rotate({{1, disc}}, 0, 0, 0, 0, 0, 1, 0.3 * i);
    occ::translate({{1, disc}}, 0, 0, 25 * i);
    wires.push_back(occ::addWire({disc}));
  }
  Solids solids;
  occ::addThruSections(wires, solids, -1, true, false);
}
void crankshaft() {  // journals, webs and pin, centre holes at both ends
  auto shaft = fused(rod(0, 0, 0, 30, 10), rod(0, 0, 66, 34, 10));
  shaft = fused(shaft, rod(16, 0, 36, 24, 9));
  shaft = fused(shaft, block(-14, -14, 28, 42, 28, 10));
  shaft = fused(shaft, block(-14, -14, 58, 42, 28, 10));
  shaft = without(shaft, centre_hole(centre_drill(2.5, 5.3, 5, 100), 100));
  auto other = centre_hole(centre_drill(2.5, 5.3, 5, 100), 100);
  occ::rotate(other, 0, 0, 50, 1, 0, 0, pi);
  without(shaft, other);
}
void crankshaft_with_points() {  // round webs, as wide as journals, and centres that come to a point
  auto shaft = fused(fused(rod(0, 0, 0, 30, 10), rod(0, 0, 60, 30, 10)), rod(14, 0, 40, 10, 10));
  shaft = fused(shaft, link(10, 10, 14, 30, 10));
  shaft = fused(shaft, link(10, 10, 14, 50, 10));
  shaft = without(shaft, turned({{0, 84}, {3.4641, 90}, {3.4641, 91}, {0, 91}}));
  without(shaft, turned({{0, 6}, {3.4641, 0}, {3.4641, -1}, {0, -1}}));
}
void cone_cup() {  // hollow: a tip inside and one outside, walls even
  turned({{0, 0}, {20, 30}, {16, 30}, {0, 6}});
}
void disc_spring() {
  turned({{10, 3}, {25, 0}, {25, 1.8}, {10, 4.8}});
}
void eye() {
  fused({{3, occ::addTorus(0, 0, 0, 16, 5)}}, {{3, occ::addCylinder(14, 0, 0, 40, 0, 0, 5)}});
}
void lens() {
  Solids result;
  std::vector<Solids> map;
  occ::intersect(ball(0, 0, -15, 20), ball(0, 0, 15, 20), result, map);
}
void crossing_bores() {  // of one diameter: their edges branch where curvature has no bound
  auto part = without(block(-20, -20, -20, 40, 40, 40), rod(0, 0, -21, 42, 8));
  without(part, {{3, occ::addCylinder(-21, 0, 0, 42, 0, 0, 8)}});
}
void cusped_notch() {  // a groove of two arcs that meet at a zero angle on the surface's inside
  auto plate = block(-30, 0, 0, 60, 30, 10);
  plate = without(plate, rod(-8, 30, -1, 12, 8));
  without(plate, rod(8, 30, -1, 12, 8));
}
void thin_rib_with_draft() {
  auto part = block(-30, -15, 0, 60, 30, 6);
  const int p[] = {occ::addPoint(-30, -2, 6), occ::addPoint(-30, 2, 6), occ::addPoint(-30, 1.2, 24),
                   occ::addPoint(-30, -1.2, 24)};
  Solids all, rib;
  occ::extrude(
      {{2, occ::addPlaneSurface({occ::addWire({occ::addLine(p[0], p[1]), occ::addLine(p[1], p[2]),
                                               occ::addLine(p[2], p[3]), occ::addLine(p[3], p[0])})})}},
      60, 0, 0, all);
  for (const auto& entity : all)
    if (entity.first == 3) rib.push_back(entity);
  fused(part, rib);
}
void balls_that_touch() {
  ball(0, 0, 0, 10);
  ball(20, 0, 0, 10);
}
void tip_on_a_plate() {
  block(-15, -15, 0, 30, 30, 8);
  occ::addCone(0, 0, 28, 0, 0, -20, 8, 0);
}
void rod_on_a_plate() {
  block(-20, -15, 0, 40, 30, 8);
  occ::addCylinder(-15, 0, 16, 30, 0, 0, 8);
}

}  // namespace

const std::vector<CadPart>& cad_parts() {
  static const std::vector<std::string> touching = {"2 parts", "in a point or along a line alone, at (",
                                                    "overlap in the CAD"};
  static const std::vector<CadPart> parts = {
      {"centre hole, form A", centre_a, 1},
      {"centre hole, form B", centre_b, 1},
      {"centre hole, form C", centre_c, 1},
      {"centre hole, form R", centre_r, 1},
      {"centre hole, form D", centre_d, 1},
      {"centre hole to a point", centre_to_a_point, 1},
      {"centre holes at both ends", centres_at_both_ends, 2},
      {"drill tip, 118 degrees", tip_118, 1},
      {"drill tip, 90 degrees", tip_90, 1},
      {"drill tip off the axis", tip_off_the_axis, 1},
      {"drill tip, oblique", tip_oblique, 1},
      {"drill tip near a bore", tip_into_a_bore, 1},
      {"stepped drill", stepped_drill, 1},
      {"four drill tips", four_tips, 4},
      {"pointed bar", pointed_bar},
      {"needle", needle, 0, {"surface 2", "tip of 11.4 degrees at (", "cut the tip off flat"}},
      {"needle of a spline", spline_needle, 0, {"tip", "28.1 degrees at (", "cut the tip off flat"}},
      {"points at both ends", two_points},
      {"point on an oblique base", oblique_point},
      {"half ball on a bar", half_ball_end},
      {"ball stud", ball_stud},
      {"ball nose hole", ball_nose_hole},
      {"shallow dimple", shallow_dimple},
      {"tangent arm on a boss", arm_boss},
      {"connecting rod", connecting_rod},
      {"lever, one side tangent", tangent_lever},
      {"crank webs, tangent", crank_webs},
      {"rib tangent to a boss", tangent_rib},
      {"rod sunk into a plate", lying_rod},
      {"boss with four ribs", boss_with_ribs},
      {"fillet beside an arm", runout_fillets},
      {"countersunk holes", countersunk},
      {"counterbored hole", counterbored},
      {"thread as grooves", sharp_grooves},
      {"relief groove, tangent", round_groove},
      {"pipe elbow", pipe_elbow},
      {"swept along a spline", swept_along_a_spline},
      {"lofted, square to circle", lofted},
      {"lofted blade", lofted_blade},
      {"crankshaft", crankshaft, 2},
      {"crankshaft, tangent webs", crankshaft_with_points, 2},
      {"hollow cone", cone_cup, 1},
      {"disc spring", disc_spring},
      {"eye", eye},
      {"lens", lens},
      {"crossing bores", crossing_bores},
      {"cusped notch", cusped_notch},
      {"rib with draft", thin_rib_with_draft},
      {"balls that touch", balls_that_touch, 0, touching},
      {"tip on a plate", tip_on_a_plate, 0, touching},
      {"rod lying on a plate", rod_on_a_plate, 0, touching},
  };
  return parts;
}
