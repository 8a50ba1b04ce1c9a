#include "pipelines/scene_shaft.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "pipelines/nearest.h"

namespace pipelines {
namespace {

const std::string eccentric_seat = "eccentric_seat";

/// Where the loads of the vibratory mill enter its shaft.
const std::vector<std::string>& needed_ports() {
  static const std::vector<std::string> ports = {eccentric_seat, "main_bearing_1", "main_bearing_2",
                                                 "debalance_1",  "debalance_2",    "coupling"};
  return ports;
}

std::string mm(double length_m) {
  return shown(std::round(length_m * 1e9) / 1e6) + " mm";
}

/// The contour as written: segments, and for each shoulder the entry of its fillet, if it has one.
struct Contour {
  std::vector<meshes::ShaftSegment> segments;  // begin_m is 0, end_m the length
  std::vector<double> fillets_m;
  std::vector<SceneTable> segment_tables;
  std::vector<std::optional<SceneTable>> fillet_tables;
};

meshes::ShaftSegment read_segment(SceneTable& table, const kinetics::VibratoryMill& mill) {
  meshes::ShaftSegment segment;
  segment.is_port = table.has("port");
  if (segment.is_port && table.has("name"))
    table.refuse("name", "a port is called by its port; remove the name");
  if (!segment.is_port) table.know("port");
  segment.name = table.text(segment.is_port ? "port" : "name",
                            "is missing; give the segment a name, or a port where load enters it");
  table.know("name");
  if (segment.is_port && !segment.name.empty()) {
    const auto& known = needed_ports();
    if (std::find(known.begin(), known.end(), segment.name) == known.end()) {
      const std::string nearest = nearest_name(segment.name, known);
      table.refuse("port", nearest.empty()
                               ? "no load of this machine enters here; ports are: " + listed(known)
                               : "unknown port; did you mean \"" + nearest + "\"?");
    }
  } else if (segment.name == "end_1" || segment.name == "end_2") {
    table.refuse("name", "is the name of an end face; take another one");
  }
  segment.diameter_m = table.quantity("diameter", "m", positive(10));
  segment.end_m = table.quantity("length", "m", positive(100));
  const bool is_seat = segment.name == eccentric_seat;
  if (is_seat || table.has("eccentricity"))
    segment.eccentricity_m =
        table.quantity_or("eccentricity", "m", not_negative(0.1), mill.eccentricity_m, "that of the drive");
  else
    table.know("eccentricity");
  if (is_seat && std::abs(segment.eccentricity_m - mill.eccentricity_m) > 1e-9 * mill.eccentricity_m)
    table.refuse("eccentricity", "differs from machine.drive.eccentricity, " + mm(mill.eccentricity_m) +
                                     ": forces and moments on the shaft would not close; remove it here");
  table.finish();
  return segment;
}

Contour read_contour(std::vector<SceneTable> entries, const kinetics::VibratoryMill& mill) {
  Contour contour;
  std::optional<SceneTable> fillet_table;
  double fillet_m = 0;
  for (SceneTable& entry : entries) {
    if (!entry.has("fillet")) {
      if (!contour.segments.empty()) {
        contour.fillets_m.push_back(fillet_m);
        contour.fillet_tables.push_back(fillet_table);
      }
      contour.segments.push_back(read_segment(entry, mill));
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

void check_names(Contour& contour, SceneTable& shaft) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < contour.segments.size(); ++i) {
    const auto& segment = contour.segments[i];
    if (!segment.name.empty() && !names.insert(segment.name).second)
      contour.segment_tables[i].refuse(segment.is_port ? "port" : "name",
                                       "is the name of two segments; give each its own");
  }
  std::vector<std::string> missing;
  for (const std::string& port : needed_ports()) {
    const auto is_meant = [&](const auto& segment) {  // a misspelt port is reported already
      return segment.is_port && (segment.name == port || nearest_name(segment.name, needed_ports()) == port);
    };
    if (std::none_of(contour.segments.begin(), contour.segments.end(), is_meant)) missing.push_back(port);
  }
  if (!missing.empty() && shaft.has("contour"))
    shaft.refuse("contour", "loads have no place to enter: no segment has the port " + listed(missing) +
                                "; write port = \"" + missing.front() + "\" in place of that segment's name");
}

/// A step needs r < (D - d) / 2 - offset of the axes; coupling specification 7.1.
void check_shoulder(Contour& contour, std::size_t i, SceneFindings& findings) {
  const auto& left = contour.segments[i];
  const auto& right = contour.segments[i + 1];
  const double height_m = std::abs(left.diameter_m - right.diameter_m) / 2;
  const double offset_m = std::abs(left.eccentricity_m - right.eccentricity_m);
  const double room_m = height_m - offset_m;
  const double rounding_m = 1e-9 * (left.diameter_m + right.diameter_m);
  const std::string step = "the step from " + mm(left.diameter_m) + " to " + mm(right.diameter_m) + " is " +
                           mm(height_m) + " high" +
                           (offset_m > 0 ? ", less " + mm(offset_m) + " of eccentricity" : "");
  auto& fillet = contour.fillet_tables[i];
  if (offset_m > 0 && room_m <= rounding_m) {
    const bool left_is_off = left.eccentricity_m > right.eccentricity_m;
    contour.segment_tables[left_is_off ? i : i + 1].refuse(
        "eccentricity", "\"" + (left.diameter_m < right.diameter_m ? left : right).name +
                            "\" would stick out of its neighbour: " + step +
                            "; enlarge the step or shrink the eccentricity");
  } else if (fillet && contour.fillets_m[i] > 0 && room_m <= rounding_m) {
    fillet->refuse("fillet", "there is no step to round: both segments have " + mm(left.diameter_m) +
                                 "; remove the fillet or change a diameter");
  } else if (fillet && contour.fillets_m[i] >= room_m - rounding_m) {
    fillet->refuse("fillet", "is too large: " + step + "; the radius must be less than " + mm(room_m));
  } else if (!fillet && room_m > rounding_m) {
    findings.warnings.push_back("the shoulder between \"" + left.name + "\" and \"" + right.name +
                                "\" has no fillet: a sharp corner has no converged peak stress");
  }
}

/// The fillets of a segment, on the side of the smaller diameter, take their length from it; the loaded zone
/// of a port stays centred in what the larger one leaves.
void check_length(Contour& contour, std::size_t i) {
  const auto& segment = contour.segments[i];
  const auto carried = [&](std::size_t shoulder, std::size_t neighbour) {
    return segment.diameter_m < contour.segments[neighbour].diameter_m ? contour.fillets_m[shoulder] : 0;
  };
  const double left_m = i > 0 ? carried(i - 1, i - 1) : 0;
  const double right_m = i + 1 < contour.segments.size() ? carried(i, i + 1) : 0;
  const double taken_m = segment.is_port ? 2 * std::max(left_m, right_m) : left_m + right_m;
  if (taken_m < segment.end_m || std::isnan(taken_m) || std::isnan(segment.end_m)) return;
  auto& fillet = contour.fillet_tables[left_m > right_m ? i - 1 : i];
  fillet->refuse("fillet", "is too long for \"" + segment.name + "\", " + mm(segment.end_m) +
                               " long, of which " +
                               (segment.is_port ? "the fillets, counted alike at both ends of a port, take "
                                                : "the fillets take ") +
                               mm(taken_m) + "; make it smaller or the segment longer");
}

/// Lengths to places: the given begin, or the one that puts z = 0 in the middle of the eccentric seat.
meshes::Shaft placed(const Contour& contour, SceneTable& shaft) {
  double z_m = 0, middle_m = 0;
  for (const auto& segment : contour.segments) {
    if (segment.name == eccentric_seat) middle_m = z_m + segment.end_m / 2;
    z_m += segment.end_m;
  }
  z_m = shaft.quantity_or("begin", "m", between(-100, 100), -middle_m,
                          "left end; z = 0 in the middle of the eccentric seat");
  meshes::Shaft result{contour.segments, contour.fillets_m};
  for (auto& segment : result.segments) {
    segment.begin_m = z_m;
    segment.end_m += z_m;
    z_m = segment.end_m;
  }
  return result;
}

meshes::ShaftMeshControl read_mesh(SceneTable mesh) {
  const meshes::ShaftMeshControl usual;
  meshes::ShaftMeshControl control;
  control.cells_per_fillet_quarter = mesh.count_or("cells_per_fillet_quarter", 2, 64,
                                                   usual.cells_per_fillet_quarter, "along a quarter circle");
  if (control.cells_per_fillet_quarter % 2 != 0)
    mesh.refuse("cells_per_fillet_quarter",
                "must be even; write " + std::to_string(control.cells_per_fillet_quarter + 1));
  control.n_sectors = mesh.count_or("sectors", 8, 256, usual.n_sectors, "cells around");
  if (control.n_sectors % 4 != 0)
    mesh.refuse("sectors",
                "must be a multiple of 4; write " + std::to_string((control.n_sectors / 4 + 1) * 4));
  control.growth = mesh.quantity_or("growth", "1", between(0.05, 1), usual.growth,
                                    "slope of the cell size away from fillets");
  mesh.know("largest_cell");
  if (mesh.has("largest_cell")) control.largest_cell_m = mesh.quantity("largest_cell", "m", positive(10));
  control.min_scaled_jacobian = mesh.quantity_or("min_scaled_jacobian", "1", between(0.01, 0.99),
                                                 usual.min_scaled_jacobian, "worse meshes are refused");
  mesh.finish();
  return control;
}

void read_material(SceneTable material, ShaftScene& scene) {
  scene.material_name = material.text("name");
  scene.material.youngs_modulus_Pa = material.quantity("youngs_modulus", "Pa", between(1e8, 2e12));
  scene.material.poisson_ratio = material.quantity("poisson_ratio", "1", between(0, 0.49));
  scene.material.density_kg_m3 = material.quantity("density", "kg/m3", between(100, 30000));
  scene.yield_strength_Pa = material.quantity("yield_strength", "Pa", between(1e6, 1e10));
  material.finish();
}

}  // namespace

ShaftScene read_shaft(SceneTable& shaft, const kinetics::VibratoryMill& mill, SceneFindings& findings) {
  ShaftScene scene;
  Contour contour = read_contour(shaft.tables("contour"), mill);
  if (shaft.is_present()) check_names(contour, shaft);
  for (std::size_t i = 0; i + 1 < contour.segments.size(); ++i) check_shoulder(contour, i, findings);
  for (std::size_t i = 0; i < contour.segments.size(); ++i) check_length(contour, i);
  scene.geometry = placed(contour, shaft);

  scene.pressure_harmonics =
      shaft.count_or("pressure_harmonics", 0, 16, scene.pressure_harmonics, "of the seat pressure");
  if (scene.pressure_harmonics % 2 != 0)
    shaft.refuse("pressure_harmonics",
                 "must be even: a half-cosine has no odd harmonic above the first; write " +
                     std::to_string(scene.pressure_harmonics + 1));
  shaft.know("debalance_shares");
  if (shaft.has("debalance_shares")) {
    scene.debalance_shares = shaft.quantities("debalance_shares", "1", between(0, 1), 2);
    if (std::abs(scene.debalance_shares[0] + scene.debalance_shares[1] - 1) > 1e-9)
      shaft.refuse("debalance_shares", "must add up to 1: they are the shares of one mass");
  } else {
    shaft.record_default("debalance_shares", "[0.5, 0.5]", "both debalances alike");
  }
  read_material(shaft.table("material"), scene);
  scene.mesh = read_mesh(shaft.table_or_empty("mesh"));
  shaft.finish();
  return scene;
}

}  // namespace pipelines
