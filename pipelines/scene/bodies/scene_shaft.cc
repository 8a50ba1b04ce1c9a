#include "pipelines/base/common/constants.h"
#include "pipelines/scene/bodies/scene_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <set>
#include <utility>

#include "pipelines/base/names/name_fault.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

std::string mm(double length_m) {
  return shown(std::round(length_m * 1e9) / 1e6) + " mm";
}

/// "eccentric_seat" as one says it.
std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// The contour as written: segments, and for each shoulder the entry of its fillet, if it has one.
struct Contour {
  std::vector<meshes::ShaftSegment> segments;  // begin_m is 0, end_m the length
  std::vector<double> fillets_m;
  std::vector<SceneTable> segment_tables;
  std::vector<std::optional<SceneTable>> fillet_tables;
};

void refuse_unknown_port(SceneTable& table, const std::string& key, const std::string& port,
                         const ContourRules& rules) {
  const auto& known = rules.ports;
  if (port.empty() || rules.any_port || std::find(known.begin(), known.end(), port) != known.end()) return;
  const std::string nearest = nearest_name(port, known);
  table.refuse(key, nearest.empty() ? "no load of this machine enters here; ports are: " + listed(known)
                                    : "unknown port; did you mean \"" + nearest + "\"?");
}

void read_bore_port(SceneTable& table, const ContourRules& rules, meshes::ShaftSegment& segment) {
  if (!table.is_given("bore_port")) return;
  segment.bore_port = table.name("bore_port");
  if (!table.has("bore"))
    table.refuse("bore_port", "is a port inside a bore that is not there; give the bore's diameter as bore");
  if (segment.bore_port == "end_1" || segment.bore_port == "end_2")
    table.refuse("bore_port", "is the name of an end face; take another one");
  else
    refuse_unknown_port(table, "bore_port", segment.bore_port, rules);
}

meshes::ShaftSegment read_segment(SceneTable& table, const ContourRules& rules) {
  meshes::ShaftSegment segment;
  segment.is_port = table.has("port");
  if (segment.is_port && table.has("name"))
    table.refuse("name", "a port is called by its port; remove the name");
  if (!segment.is_port) table.know("port");
  segment.name = table.name(segment.is_port ? "port" : "name",
                            "is missing; give the segment a name, or a port where load enters it");
  table.know("name");
  if (segment.is_port && !rules.any_port) {
    if (name_fault(segment.name).empty()) refuse_unknown_port(table, "port", segment.name, rules);
  } else if (segment.name == "end_1" || segment.name == "end_2") {
    table.refuse(segment.is_port ? "port" : "name", "is the name of an end face; take another one");
  }
  segment.diameter_m = table.quantity("diameter", "m", positive(10));
  segment.end_m = table.quantity("length", "m", positive(100));
  const bool is_seat = segment.is_port && segment.name == rules.eccentric_seat;
  const double drive_m = rules.eccentricity_m;
  if (is_seat || table.has("eccentricity"))
    segment.eccentricity_m =
        table.quantity_or("eccentricity", "m", not_negative(0.1), drive_m, "that of the drive");
  else
    table.know("eccentricity");
  if (is_seat && std::abs(segment.eccentricity_m - drive_m) > 1e-9 * drive_m)
    table.refuse("eccentricity", "differs from machine.drive.eccentricity, " + mm(drive_m) +
                                     ": forces and moments on the shaft would not close; remove it here");
  if (table.is_given("eccentricity_angle")) {
    segment.eccentricity_angle_rad = table.quantity("eccentricity_angle", "rad", between(-2 * pi, 2 * pi));
    if (is_seat && segment.eccentricity_angle_rad != 0)
      table.refuse("eccentricity_angle", "the drive's eccentric lies along +x of the shaft; remove it here");
  }
  segment.bore_m = table.quantity_if_given("bore", "m", positive(10)).value_or(segment.bore_m);
  if (segment.bore_m >= segment.diameter_m)
    table.refuse("bore", "leaves no wall: the diameter is " + mm(segment.diameter_m) +
                             "; make it smaller, or the diameter larger");
  read_bore_port(table, rules, segment);
  table.finish();
  return segment;
}

Contour read_contour(std::vector<SceneTable> entries, const ContourRules& rules) {
  Contour contour;
  std::optional<SceneTable> fillet_table;
  double fillet_m = 0;
  for (SceneTable& entry : entries) {
    if (!entry.has("fillet")) {
      if (!contour.segments.empty()) {
        contour.fillets_m.push_back(fillet_m);
        contour.fillet_tables.push_back(fillet_table);
      }
      contour.segments.push_back(read_segment(entry, rules));
      contour.segment_tables.push_back(entry);
      fillet_table.reset();
      fillet_m = 0;
      continue;
    }
    if (contour.segments.empty() || fillet_table)
      entry.refuse("fillet",
                   "stands between no two segments; write it between those whose shoulder it rounds");
    fillet_m = entry.quantity("fillet", "m", positive(1));
    fillet_table = entry;
    entry.finish();
  }
  if (fillet_table && !contour.segments.empty())
    fillet_table->refuse("fillet", "no segment follows; write it between those whose shoulder it rounds");
  return contour;
}

void check_names(Contour& contour, SceneTable& body, const ContourRules& rules) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < contour.segments.size(); ++i) {
    const auto& segment = contour.segments[i];
    if (!segment.name.empty() && !names.insert(segment.name).second)
      contour.segment_tables[i].refuse(segment.is_port ? "port" : "name",
                                       "is the name of two segments; give each its own");
    if (!segment.bore_port.empty() && !names.insert(segment.bore_port).second)
      contour.segment_tables[i].refuse("bore_port", "is the name of two ports; give each its own");
  }
  std::vector<std::string> missing;
  for (const std::string& port : rules.ports) {
    const auto is_meant = [&](const auto& segment) {
      const auto is = [&](const std::string& name) {
        if (name == port || rules.any_port || name.empty() || contains(rules.ports, name))
          return name == port;
        return nearest_name(name, rules.ports) == port;  // a misspelt port is reported already
      };
      return is(segment.bore_port) || (segment.is_port && is(segment.name));
    };
    if (std::none_of(contour.segments.begin(), contour.segments.end(), is_meant)) missing.push_back(port);
  }
  if (!missing.empty() && body.has("contour"))
    body.refuse("contour", "loads have no place to enter: no segment has the port " + listed(missing) +
                               "; write port = \"" + missing.front() + "\" in place of that segment's name");
}

/// Offset of the segment's axis across. std::polar takes no negative lengths, nor those that could not be
/// read.
std::complex<double> offset_of(const meshes::ShaftSegment& segment) {
  return segment.eccentricity_m * std::complex<double>(std::cos(segment.eccentricity_angle_rad),
                                                       std::sin(segment.eccentricity_angle_rad));
}

/// A step needs r < (D - d) / 2 - offset of the axes; coupling specification 7.1.
void check_shoulder(Contour& contour, std::size_t i, SceneFindings& findings) {
  const auto& left = contour.segments[i];
  const auto& right = contour.segments[i + 1];
  const double height_m = std::abs(left.diameter_m - right.diameter_m) / 2;
  const double offset_m = std::abs(offset_of(left) - offset_of(right));
  const double room_m = height_m - offset_m;
  const double rounding_m = 1e-9 * (left.diameter_m + right.diameter_m);
  const auto step = [&] {
    return "the step from " + mm(left.diameter_m) + " to " + mm(right.diameter_m) + " is " + mm(height_m) +
           " high" + (offset_m > 0 ? ", less " + mm(offset_m) + " of eccentricity" : "");
  };
  auto& fillet = contour.fillet_tables[i];
  if (offset_m > 0 && room_m <= rounding_m) {
    const bool left_is_off = left.eccentricity_m > right.eccentricity_m;
    contour.segment_tables[left_is_off ? i : i + 1].refuse(
        "eccentricity", "\"" + (left.diameter_m < right.diameter_m ? left : right).name +
                            "\" would stick out of its neighbour: " + step() +
                            "; enlarge the step or shrink the eccentricity");
  } else if (fillet && contour.fillets_m[i] > 0 && room_m <= rounding_m) {
    fillet->refuse("fillet", "there is no step to round: both segments have " + mm(left.diameter_m) +
                                 "; remove the fillet or change a diameter");
  } else if (fillet && contour.fillets_m[i] >= room_m - rounding_m) {
    fillet->refuse("fillet", "is too large: " + step() + "; the radius must be less than " + mm(room_m));
  } else if (!fillet && room_m > rounding_m) {
    findings.warnings.push_back("the shoulder between \"" + left.name + "\" and \"" + right.name +
                                "\" has no fillet: a sharp corner has no converged peak stress");
  }
}

/// The fillets of a segment, on the side of the smaller diameter, take their length from it; the loaded zone
/// of a port stays centred in what the larger one leaves.
void check_length(Contour& contour, std::size_t i, SceneFindings& findings) {
  const auto& segment = contour.segments[i];
  const auto carried = [&](std::size_t shoulder, std::size_t neighbour) {
    return segment.diameter_m < contour.segments[neighbour].diameter_m ? contour.fillets_m[shoulder] : 0;
  };
  const double left_m = i > 0 ? carried(i - 1, i - 1) : 0;
  const double right_m = i + 1 < contour.segments.size() ? carried(i, i + 1) : 0;
  const double taken_m = segment.is_port ? 2 * std::max(left_m, right_m) : left_m + right_m;
  if (taken_m < segment.end_m || std::isnan(taken_m) || std::isnan(segment.end_m)) {
    if (segment.is_port && taken_m > segment.end_m / 2)
      findings.warnings.push_back(
          "the port \"" + segment.name + "\" is loaded over " + mm(segment.end_m - taken_m) + " of its " +
          mm(segment.end_m) +
          ": its fillets take their length at both of its ends; put a segment between port and "
          "fillet if that is not meant");
    return;
  }
  auto& fillet = contour.fillet_tables[left_m > right_m ? i - 1 : i];
  fillet->refuse("fillet", "is too long for \"" + segment.name + "\", " + mm(segment.end_m) +
                               " long, of which " +
                               (segment.is_port ? "the fillets, counted alike at both ends of a port, take "
                                                : "the fillets take ") +
                               mm(taken_m) + "; make it smaller or the segment longer");
}

/// A groove between sharp corners may have none of its surface judged, however large its stress.
void check_sharp_grooves(const meshes::Shaft& shaft, double exclusion_m, SceneFindings& findings) {
  const auto& segments = shaft.segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto is_sharp = [&](std::size_t shoulder, std::size_t neighbour) {
      return shaft.fillets_m[shoulder] <= 0 && segments[neighbour].diameter_m > segments[i].diameter_m;
    };
    const int n_corners = (i > 0 && is_sharp(i - 1, i - 1)) + (i + 1 < segments.size() && is_sharp(i, i + 1));
    const double left_out_m =
        exclusion_m > 0 ? exclusion_m : meshes::sharp_shoulder_distance_m(segments[i].diameter_m);
    const double length_m = segments[i].end_m - segments[i].begin_m;
    if (length_m > 0 && n_corners > 0 && length_m <= n_corners * left_out_m)
      findings.warnings.push_back(
          "the surface of \"" + segments[i].name + "\" is judged nowhere: all of its " + mm(length_m) +
          " lie within " + mm(left_out_m) +
          " of a sharp corner, where stress is left out, however large; round its corners with fillets, as "
          "small as they are");
  }
}

/// Lengths to places: the given begin, or the one that the kind of body asks for.
meshes::Shaft placed(const Contour& contour, SceneTable& body, const ContourRules& rules) {
  double z_m = 0, middle_m = 0;
  for (const auto& segment : contour.segments) {
    if (!rules.middle.empty() && (segment.name == rules.middle || segment.bore_port == rules.middle))
      middle_m = z_m + segment.end_m / 2;
    z_m += segment.end_m;
  }
  z_m = body.quantity_or(
      "begin", "m", between(-100, 100), 0 - middle_m,
      rules.middle.empty() ? "the left end" : "left end; z = 0 in the middle of the " + spoken(rules.middle));
  meshes::Shaft result{contour.segments, contour.fillets_m};
  for (auto& segment : result.segments) {
    segment.begin_m = z_m;
    segment.end_m += z_m;
    z_m = segment.end_m;
  }
  return result;
}

meshes::ShaftMeshControl read_shaft_mesh(SceneTable mesh) {
  using Control = meshes::ShaftMeshControl;
  const Control usual;
  Control control;
  control.cells_per_fillet_quarter = mesh.count_or("cells_per_fillet_quarter", 2, 64,
                                                   usual.cells_per_fillet_quarter, "along a quarter circle");
  if (control.cells_per_fillet_quarter % 2 != 0)
    mesh.refuse("cells_per_fillet_quarter",
                "must be even; write " + std::to_string(control.cells_per_fillet_quarter + 1));
  control.n_sectors = mesh.count_or("sectors", 8, 256, usual.n_sectors, "cells around");
  if (control.n_sectors % 4 != 0)
    mesh.refuse("sectors",
                "must be a multiple of 4; write " + std::to_string((control.n_sectors / 4 + 1) * 4));
  control.growth = mesh.quantity_or("growth", "1", between(0.05, Control::steepest_growth), usual.growth,
                                    "slope of the cell size away from fillets");
  control.largest_cell_m =
      mesh.quantity_if_given("largest_cell", "m", positive(10)).value_or(control.largest_cell_m);
  control.min_scaled_jacobian = mesh.quantity_or("min_scaled_jacobian", "1", between(0.01, 0.99),
                                                 usual.min_scaled_jacobian, "worse meshes are refused");
  mesh.finish();
  return control;
}

}  // namespace

ShaftShape read_shaft_shape(SceneTable& body, const ContourRules& rules, SceneFindings& findings) {
  ShaftShape shape;
  Contour contour = read_contour(body.tables("contour"), rules);
  if (body.is_present()) check_names(contour, body, rules);
  for (std::size_t i = 0; i + 1 < contour.segments.size(); ++i) check_shoulder(contour, i, findings);
  for (std::size_t i = 0; i < contour.segments.size(); ++i) check_length(contour, i, findings);
  shape.geometry = placed(contour, body, rules);
  shape.keyways = read_keyways(body);
  for (const auto& keyway : shape.keyways)
    findings.warnings.push_back(
        "the keyway on \"" + keyway.segment +
        "\" has sharp edges at its root: the stress there has no converged peak and is left "
        "out; judge it by notch factors");
  if (shape.keyways.empty())
    shape.mesh = read_shaft_mesh(body.table_or_empty("mesh"));
  else
    shape.solid = read_solid_control(body.table_or_empty("mesh"));
  check_sharp_grooves(shape.geometry, shape.solid.exclusion_m, findings);
  return shape;
}

}  // namespace pipelines
