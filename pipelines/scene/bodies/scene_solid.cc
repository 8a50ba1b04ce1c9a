#include <algorithm>
#include <cmath>
#include <utility>

#include "meshes/imported/file_checks.h"
#include "pipelines/base/fatigue/weld_classes.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/bodies/scene_body.h"

namespace pipelines {
namespace {

constexpr double longest_part_m = 100;

std::array<double, 3> point(SceneTable& table, const std::string& name) {
  const auto values = table.quantities(name, "m", between(-longest_part_m, longest_part_m), 3);
  return values.size() == 3 ? std::array<double, 3>{values[0], values[1], values[2]}
                            : std::array<double, 3>{};
}

meshes::CylinderSelection read_cylinder(SceneTable table) {
  meshes::CylinderSelection cylinder;
  if (table.is_given("axis")) {
    const auto axis = table.quantities("axis", "m", between(-longest_part_m, longest_part_m), 2);
    if (axis.size() == 2) cylinder.axis_x_m = axis[0], cylinder.axis_y_m = axis[1];
  } else {
    table.record_default("axis", "[0, 0]", "the z axis");
  }
  cylinder.radius_m = table.quantity("diameter", "m", positive(longest_part_m)) / 2;
  cylinder.begin_m = table.quantity("begin", "m", between(-longest_part_m, longest_part_m));
  cylinder.end_m = table.quantity("end", "m", between(-longest_part_m, longest_part_m));
  if (cylinder.end_m <= cylinder.begin_m)
    table.refuse("end", "must lie beyond begin: they are the ends of the range in z");
  const std::string side = table.text_or("side", "outside", "of a shaft; \"inside\" of a hole");
  if (side == "inside") cylinder.side = meshes::CylinderSelection::Side::inside;
  if (!side.empty() && side != "inside" && side != "outside")
    table.refuse("side", "write \"outside\" (of a shaft) or \"inside\" (of a hole)");
  table.finish();
  return cylinder;
}

meshes::ImportPort read_port(SceneTable& table) {
  meshes::ImportPort port;
  port.name = table.name("port");
  std::vector<std::string> given;
  for (const char* way : {"group", "box", "cylinder"}) {
    if (table.is_given(way)) given.push_back(way);
  }
  if (given.size() != 1) {
    const std::string remedy =
        "say in one way where the port is: group (a physical group of the .msh), box (low, high) or cylinder "
        "(diameter, begin, end)";
    if (given.empty())
      table.refuse_missing("cylinder", "is missing; " + remedy);
    else
      table.refuse(given.back(), "is one way too many; " + remedy);
  } else if (given.front() == "group") {
    port.selection = meshes::GroupSelection{table.text("group")};
  } else if (given.front() == "box") {
    SceneTable box = table.table("box");
    meshes::BoxSelection selection;
    selection.low_m = point(box, "low");
    selection.high_m = point(box, "high");
    for (int d = 0; d < 3; ++d)
      if (selection.high_m[d] < selection.low_m[d]) {
        box.refuse("high",
                   std::string("lies below low in ") + "xyz"[d] + ": they are opposite corners of the box");
        break;
      }
    box.finish();
    port.selection = selection;
    port.kind = meshes::Port::Kind::face;
  } else {
    const auto cylinder = read_cylinder(table.table("cylinder"));
    port.selection = cylinder;
    if (cylinder.side == meshes::CylinderSelection::Side::inside) port.kind = meshes::Port::Kind::bore;
  }
  if (table.is_given("kind")) {
    const std::string kind = table.text("kind");
    using Kind = meshes::Port::Kind;
    if (kind == "seat" || kind == "bore" || kind == "face")
      port.kind = kind == "seat" ? Kind::seat : kind == "bore" ? Kind::bore : Kind::face;
    else if (!kind.empty())
      table.refuse(
          "kind",
          "write \"seat\" (outside of a cylinder), \"bore\" (inside of one) or \"face\" (anything else)");
  }
  table.finish();
  return port;
}

/// Reference radius of an effective notch: those that fatigue classes are known for.
double read_notch_radius(SceneTable& table) {
  constexpr double rounding = 1e-9;
  const double radius_m = table.quantity("radius", "m", positive(longest_part_m));
  for (const double reference_m : {notch_radius_m, notch_radius_of_thin_plates_m})
    if (std::abs(radius_m - reference_m) <= rounding * reference_m) return reference_m;
  table.refuse(
      "radius",
      "write \"1 mm\", or \"0.05 mm\" of plates thinner than 5 mm: fatigue classes of effective notch "
      "stress are for these; a fillet that the part has belongs in the model");
  return notch_radius_m;
}

/// A sharp inner edge that is a weld: judged by its hot-spot stress, or rounded for its effective notch
/// stress.
void read_edge(SceneTable& table, meshes::Import& import) {
  const auto at_m = point(table, "at");
  const std::string kind = table.text("kind");
  for (const char* key : {"thickness", "radius"}) table.know(key);
  if (kind == "weld")
    import.welds.push_back({at_m, table.quantity("thickness", "m", positive(longest_part_m))});
  else if (kind == "notch")
    import.notches.push_back({at_m, read_notch_radius(table)});
  else if (!kind.empty())
    table.refuse(
        "kind",
        "write \"weld\", whose hot-spot stress is read, or \"notch\", which is rounded by a reference "
        "radius for its effective notch stress; an edge that is no weld needs its fillet in the model");
  if (table.has("radius") && kind == "weld")
    table.refuse("radius", "is of kind = \"notch\"; of a weld's hot-spot stress the thickness counts");
  if (table.has("thickness") && kind == "notch")
    table.refuse("thickness", "is of kind = \"weld\"; of a notch the radius counts");
  table.finish();
}

}  // namespace

meshes::SolidControl read_solid_control(SceneTable mesh) {
  const meshes::SolidControl usual;
  meshes::SolidControl control;
  control.size_m = mesh.quantity_if_given("size", "m", positive(longest_part_m)).value_or(control.size_m);
  control.smallest_size_m = mesh.quantity_if_given("smallest_size", "m", positive(longest_part_m))
                                .value_or(control.smallest_size_m);
  control.cells_per_circle =
      mesh.count_or("cells_per_circle", 6, 400, usual.cells_per_circle, "around every curved surface");
  control.min_scaled_jacobian = mesh.quantity_or("min_scaled_jacobian", "1", between(0.001, 0.99),
                                                 usual.min_scaled_jacobian, "worse meshes are refused");
  control.exclusion_m =
      mesh.quantity_if_given("exclusion", "m", positive(longest_part_m)).value_or(control.exclusion_m);
  mesh.finish();
  return control;
}

meshes::Import read_import(SceneTable& body, const std::filesystem::path& scene_directory,
                           const std::vector<std::string>& needed_ports) {
  meshes::Import import;
  const std::string file = body.text("file");
  import.geometry = scene_directory / file;
  std::error_code none;
  if (!file.empty() && !std::filesystem::is_regular_file(import.geometry, none))
    body.refuse("file", "there is no such file; its path counts from the scene's folder");
  else if (const auto size = size_of_file(import.geometry); size > meshes::most_bytes_of_a_geometry)
    body.refuse("file", "the file has " + size_text(size) + ", and at most " +
                            size_text(meshes::most_bytes_of_a_geometry) +
                            " are read; export the part alone, or mesh it coarser");
  else
    note_input(import.geometry);
  import.scale_to_m = body.quantity_if_given("length_unit", "m", positive(1e3)).value_or(import.scale_to_m);
  for (SceneTable& table : body.tables("ports")) import.ports.push_back(read_port(table));
  for (SceneTable& table : body.tables_if_any("edges")) read_edge(table, import);
  std::vector<std::string> missing;
  for (const auto& name : needed_ports)
    if (std::none_of(import.ports.begin(), import.ports.end(), [&](const auto& p) { return p.name == name; }))
      missing.push_back(name);
  if (!missing.empty() && body.has("ports"))
    body.refuse("ports", "loads have no place to enter: add the port " + listed(missing));
  SceneTable mesh = body.table_or_empty("mesh");
  import.time_limit_s =
      mesh.quantity_if_given("time_limit", "s", between(1, 1e6)).value_or(import.time_limit_s);
  import.control = read_solid_control(std::move(mesh));
  return import;
}

std::vector<meshes::Keyway> read_keyways(SceneTable& body) {
  std::vector<meshes::Keyway> keyways;
  for (SceneTable& table : body.tables_if_any("keyways")) {
    meshes::Keyway keyway;
    keyway.segment = table.text("segment");
    keyway.width_m = table.quantity("width", "m", positive(longest_part_m));
    keyway.depth_m = table.quantity("depth", "m", positive(longest_part_m));
    keyway.length_m = table.quantity("length", "m", positive(longest_part_m));
    keyway.begin_m = table.quantity("begin", "m", between(-longest_part_m, longest_part_m));
    keyway.angle_rad =
        table.quantity_or("angle", "rad", between(-10, 10), 0, "its middle line lies along +x");
    keyway.round_ends = table.flag_or("round_ends", true, "milled with an end mill");
    table.finish();
    keyways.push_back(keyway);
  }
  return keyways;
}

}  // namespace pipelines
