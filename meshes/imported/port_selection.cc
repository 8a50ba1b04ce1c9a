#include "meshes/imported/port_selection.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "meshes/values/refused.h"

namespace meshes {

namespace {

// Share of the radius within which a cylinder still counts as the one meant.
constexpr double near_share = 0.02;
// Share of the radius within which surfaces lie on one and the same cylinder.
constexpr double same_share = 1e-3;
constexpr double range_share = 1e-3;  // share of the length asked for by which z may be off

[[noreturn]] void refuse(const ImportPort& port, const std::string& what) {
  throw GeometryRefused("port " + port.name + ": " + what);
}

std::string candidates(const ModelMesh& model, const std::vector<PieceShape>& shapes, bool only_cylinders) {
  constexpr std::size_t most = 40;  // lines a person reads
  std::string list;
  std::size_t n = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (only_cylinders && !shapes[i].cylinder) continue;
    if (++n <= most) list += "\n  " + name_of(model.pieces[i]) + ": " + describe(shapes[i]);
  }
  if (n > most) list += "\n  and " + std::to_string(n - most) + " more";
  return list.empty() ? " none" : list;
}

/// gmsh writes what is in physical groups: of a .msh that has one of volumes only, the surface is in one
/// piece.
void require_surfaces(const ImportPort& port, const ModelMesh& model) {
  for (const auto& piece : model.pieces)
    if (piece.tag != 0 || !piece.name.empty()) return;
  refuse(port,
         "the file has no cells on its surfaces, only in its volumes: put the surfaces into physical groups "
         "too, "
         "and write it again");
}

struct Select {
  const ImportPort& port;
  const ModelMesh& model;
  const std::vector<PieceShape>& shapes;

  std::vector<int> operator()(const GroupSelection& group) const {
    std::vector<int> chosen;
    std::set<std::string> names;
    for (std::size_t i = 0; i < model.pieces.size(); ++i) {
      const auto& groups = model.pieces[i].groups;
      names.insert(groups.begin(), groups.end());
      if (std::find(groups.begin(), groups.end(), group.name) != groups.end()) chosen.push_back(int(i));
    }
    if (!chosen.empty()) return chosen;
    const auto listed = [](const auto& all) {
      std::string text;
      for (const auto& name : all) text += (text.empty() ? "" : ", ") + name;
      return text;
    };
    const auto& empty = model.empty_groups;
    if (std::find(empty.begin(), empty.end(), group.name) != empty.end())
      refuse(port,
             "the file names the group \"" + group.name +
                 "\", but none of its elements says that it belongs to it, as gmsh writes version 2.2 with "
                 "Mesh.SaveAll = 1: write it with Mesh.SaveAll = 0, or as version 4.1");
    refuse(port, "the body has no group of surfaces \"" + group.name + "\"; " +
                     (!names.empty() ? "its groups are " + listed(names)
                      : !empty.empty()
                          ? "the file names the groups " + listed(empty) +
                                ", but none of its elements says that it belongs to one: write it with "
                                "gmsh's Mesh.SaveAll = 0, or as version 4.1"
                          : "it has no groups at all (STEP carries none): choose by a box or a cylinder"));
  }

  std::vector<int> operator()(const BoxSelection& box) const {
    std::vector<int> chosen;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      bool inside = true;
      for (int d = 0; d < 3; ++d) {
        const double tolerance = 1e-9 + 1e-6 * std::abs(box.high_m[d] - box.low_m[d]);
        inside = inside && shapes[i].low_m[d] >= box.low_m[d] - tolerance &&
                 shapes[i].high_m[d] <= box.high_m[d] + tolerance;
      }
      if (inside) chosen.push_back(int(i));
    }
    if (chosen.empty())
      refuse(port, "no surface lies in its box; make the box larger; the surfaces are" +
                       candidates(model, shapes, false));
    return chosen;
  }

  std::vector<int> operator()(const CylinderSelection& wanted) const {
    const double tolerance = range_share * (wanted.end_m - wanted.begin_m);
    const auto distance = [&](const FoundCylinder& c) {
      return std::hypot(c.axis_x_m - wanted.axis_x_m, c.axis_y_m - wanted.axis_y_m) +
             std::abs(c.radius_m - wanted.radius_m);
    };
    const auto overlaps = [&](const PieceShape& shape) {
      return shape.cylinder && shape.cylinder->inside == (wanted.side == CylinderSelection::Side::inside) &&
             shape.high_m[2] > wanted.begin_m + tolerance && shape.low_m[2] < wanted.end_m - tolerance;
    };
    double nearest = near_share * wanted.radius_m;
    bool found = false;
    for (const auto& shape : shapes)
      if (overlaps(shape) && distance(*shape.cylinder) <= nearest) {
        nearest = distance(*shape.cylinder);
        found = true;
      }
    if (!found)
      refuse(port, "no surface lies on its cylinder; the cylinders parallel to z are" +
                       candidates(model, shapes, true));
    std::vector<int> chosen;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (!overlaps(shapes[i]) || distance(*shapes[i].cylinder) > nearest + same_share * wanted.radius_m)
        continue;
      if (shapes[i].low_m[2] < wanted.begin_m - tolerance || shapes[i].high_m[2] > wanted.end_m + tolerance)
        refuse(port, name_of(model.pieces[i]) + " on its cylinder reaches out of its range of z: " +
                         describe(shapes[i]) + "; give the whole range, or divide the surface in the CAD");
      chosen.push_back(int(i));
    }
    return chosen;
  }
};

void check_values(const ImportPort& port, std::set<std::string>& names) {
  if (port.name.empty()) throw GeometryRefused("a port of the imported body has no name; give it one");
  if (!names.insert(port.name).second)
    throw GeometryRefused("two ports are called '" + port.name + "'; names must be unique");
  if (const auto* box = std::get_if<BoxSelection>(&port.selection))
    for (int d = 0; d < 3; ++d)
      if (!(box->low_m[d] <= box->high_m[d])) refuse(port, "its box has a low corner above the high one");
  if (const auto* cylinder = std::get_if<CylinderSelection>(&port.selection))
    if (!(cylinder->radius_m > 0) || !(cylinder->end_m > cylinder->begin_m))
      refuse(port, "its cylinder needs a positive radius, and an end beyond its begin");
}

/// Centre of the area of all pieces together, from the CAD where it has them.
Point centre_of(const std::vector<int>& pieces, const ModelMesh& model,
                const std::vector<PieceShape>& shapes) {
  const bool of_cad =
      std::all_of(pieces.begin(), pieces.end(), [&](int piece) { return model.pieces[piece].size > 0; });
  Point centre{};
  double area_m2 = 0;
  for (const int i : pieces) {
    const double its_area_m2 = of_cad ? model.pieces[i].size : shapes[i].area_m2;
    const Point& its_centre = of_cad ? model.pieces[i].centre_m : shapes[i].centre_m;
    area_m2 += its_area_m2;
    for (int d = 0; d < 3; ++d) centre[d] += its_area_m2 * its_centre[d];
  }
  for (double& x : centre) x /= area_m2;
  return centre;
}

}  // namespace

std::vector<int> assign_ports(const std::vector<ImportPort>& ports, const ModelMesh& model,
                              const std::vector<PieceShape>& shapes) {
  std::set<std::string> names;
  std::vector<int> port_of(model.pieces.size(), -1);
  for (std::size_t p = 0; p < ports.size(); ++p) {
    check_values(ports[p], names);
    require_surfaces(ports[p], model);
    for (const int piece : std::visit(Select{ports[p], model, shapes}, ports[p].selection)) {
      if (port_of[piece] >= 0)
        refuse(ports[p], name_of(model.pieces[piece]) + " (" + describe(shapes[piece]) +
                             ") already belongs to port " + ports[port_of[piece]].name +
                             "; change one of the two selections");
      port_of[piece] = int(p);
    }
  }
  for (std::size_t i = 0; i < model.pieces.size(); ++i)
    if (port_of[i] < 0 && names.count(model.pieces[i].name) > 0)
      throw GeometryRefused("port " + model.pieces[i].name +
                            " has the name of a group of surfaces that it does not take; rename it");
  return port_of;
}

Port make_port(const ImportPort& port, const ModelMesh& model, const std::vector<PieceShape>& shapes,
               const std::vector<int>& port_of_piece, int index, int boundary_id) {
  Port made;
  made.name = port.name;
  made.kind = port.kind;
  made.boundary_id = boundary_id;
  std::vector<int> pieces;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (port_of_piece[i] == index) pieces.push_back(int(i));
  if (port.kind == Port::Kind::face) {
    const Point centre = centre_of(pieces, model, shapes);
    made.axis_x_m = centre[0];
    made.axis_y_m = centre[1];
    made.begin_m = made.end_m = centre[2];
    return made;
  }
  made.begin_m = 1e300;
  made.end_m = -1e300;
  for (const int i : pieces) {
    made.begin_m = std::min(made.begin_m, shapes[i].low_m[2]);
    made.end_m = std::max(made.end_m, shapes[i].high_m[2]);
  }
  const auto cylinder = common_cylinder(model.mesh, model.mesh.face_id, pieces);
  if (!cylinder)
    refuse(port, "its surfaces are no cylinder parallel to z, which a seat or bore must be; they are" +
                     candidates(model, shapes, false) + "\nchoose others, or make it a face");
  if (cylinder->inside != (port.kind == Port::Kind::bore))
    refuse(port, std::string("its cylinder is the ") + (cylinder->inside ? "inside" : "outside") +
                     " of one; make it a " + (cylinder->inside ? "bore" : "seat") + " or choose another");
  made.axis_x_m = cylinder->axis_x_m;
  made.axis_y_m = cylinder->axis_y_m;
  made.radius_m = cylinder->radius_m;
  return made;
}

}  // namespace meshes
