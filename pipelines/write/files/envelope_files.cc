#include "pipelines/write/files/envelope_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>

#include "fem/base/values/cell_shares.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/parallel.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/texts/moment.h"
#include "pipelines/write/exports/paraview_script.h"
#include "pipelines/write/exports/vtk_files.h"
#include "pipelines/write/pictures/port_surface.h"

namespace pipelines {
namespace {

using std::filesystem::path;

constexpr double not_judged = std::numeric_limits<double>::quiet_NaN();

std::vector<double> flatten(const std::vector<Stress>& tensors) {
  std::vector<double> values;
  values.reserve(tensors.size() * 6);
  for (const auto& tensor : tensors) values.insert(values.end(), tensor.begin(), tensor.end());
  return values;
}

/// Rounds to multiples of a power of two: the zeros that this leaves at the end of the numbers make files a
/// third smaller.
void round_to(double step, std::vector<double>& values) {
  if (step > 0)
    for (double& value : values) value = std::round(value / step) * step;
}

/// A step that no viewer shows: 2^-12 of the largest value, or less.
double fine_step(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest > 0 ? std::exp2(std::ilogb(largest) - 12) : 0;
}

/// Fields with the values that they stand for.
class Fields {
public:
  void add(const std::string& name, std::vector<double> values, int n_components = 1,
           const std::vector<std::string>& component_names = {}) {
    values_.push_back(std::move(values));
    fields_.push_back(nodal_field(name, values_.back(), n_components, component_names));
  }
  /// Adds a stress in MPa and in Pa. What comes first in a file is what viewers show first.
  /// @param name  ends in "[Pa]"
  void add_stress(const std::string& name, std::vector<double> values_Pa) {
    auto values_MPa = values_Pa;
    for (double& value : values_MPa) value /= 1e6;
    add(in_MPa(name), std::move(values_MPa));
    add(name, std::move(values_Pa));
  }
  void add_tensor(const std::string& name, std::vector<double> values_Pa) {
    round_to(fine_step(values_Pa), values_Pa);
    add(name, std::move(values_Pa), 6, {"xx", "yy", "zz", "xy", "yz", "xz"});
  }
  void add_displacement(const std::string& name, std::vector<double> values_m) {
    round_to(fine_step(values_m), values_m);
    add(name, std::move(values_m), 3, {"x", "y", "z"});
  }
  const std::vector<NodalField>& fields() const { return fields_; }

private:
  std::deque<std::vector<double>> values_;  // stay where they are
  std::vector<NodalField> fields_;
};

IdField excluded_ids(const NodePlaces& places) {
  return {excluded_field, std::vector<std::int32_t>(places.excluded.begin(), places.excluded.end())};
}

/// Cells of unlike size have faces inside the body that match no other face: viewers that take such faces for
/// the surface can tell by the nodes.
IdField surface_ids(const fem::Nodes& nodes) {
  IdField field{surface_field, std::vector<std::int32_t>(nodes.n, 0)};
  for (const auto node : nodes.faces) field.values[std::size_t(node)] = 1;
  return field;
}

std::size_t nearest_node(const fem::Nodes& nodes, const std::array<double, 3>& p) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < nodes.n; ++i) {
    const double* x = &nodes.xyz_m[3 * i];
    const double dx = x[0] - p[0], dy = x[1] - p[1], dz = x[2] - p[2];
    const double d = dx * dx + dy * dy + dz * dz;
    if (d < least) least = d, best = i;
  }
  return best;
}

std::vector<double> hot_spot_values(const Judged& analysis) {
  std::vector<double> values(analysis.responses.nodes.n, not_judged);
  for (const auto& spot : analysis.hot_spots)  // a corner may be the toe of several: the largest comes first
    if (auto& value = values[nearest_node(analysis.responses.nodes, spot.toe_m)]; std::isnan(value))
      value = spot.von_mises_Pa;
  return values;
}

/// Adds utilisation on the surface; NaN inside and where nodes are left out: fatigue is not judged there.
void add_fatigue(Fields& fields, const Judged& analysis) {
  const auto& fatigue = *analysis.fatigue;
  const std::size_t n = analysis.responses.nodes.n;
  std::vector<double> amplitude(n, not_judged), mean(n, not_judged), utilisation(n, not_judged);
  for (std::size_t i = 0; i < fatigue.cycles.nodes.size(); ++i) {
    const auto node = fatigue.cycles.nodes[i];
    amplitude[node] = fatigue.cycles.cycles[i].amplitude_Pa;
    mean[node] = fatigue.cycles.cycles[i].signed_mean_Pa;
    utilisation[node] = fatigue.utilisation_at[i];
  }
  fields.add_stress("stress amplitude [Pa]", std::move(amplitude));
  fields.add_stress("mean stress [Pa]", std::move(mean));
  fields.add("fatigue utilisation without support by gradient", std::move(utilisation));
}

/// Ids of faces at their nodes; a node between several has the first one's.
IdField at_nodes(const IdField& of_faces, const fem::Nodes& nodes) {
  IdField field{of_faces.name, std::vector<std::int32_t>(nodes.n, 0)};
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (const auto node : nodes.face(f))
      if (auto& id = field.values[std::size_t(node)]; id == 0) id = of_faces.values[f];
  return field;
}

FieldData data_of(const Judged& analysis, MarkedFaces marks) {
  const auto stress = governing_stress(analysis);
  FieldData data;
  data.names = std::move(marks.names);
  data.names.push_back({"zone name", {}});
  for (const auto& zone : analysis.zones.zones) data.names.back().names.push_back(zone.feature);
  data.names.push_back({"governing stress, place", {stress.name() + " at " + stress.place}});
  data.numbers = {{"governing stress [Pa]", {stress.value_Pa}},
                  {"governing stress, position [m]", {stress.position_m.begin(), stress.position_m.end()}}};
  return data;
}

/// @param moved_m  displacement of every node, n x 3; empty: not known
void write_envelope(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                    const Judged& analysis, int n_pieces, std::vector<double> moved_m) {
  const auto& nodes = analysis.responses.nodes;
  const auto& envelope = analysis.envelope;
  const auto& effects = analysis.loads.history.effects;
  const auto angles = [&](const std::vector<std::int32_t>& instants) {
    std::vector<double> degrees;
    for (const auto instant : instants)
      degrees.push_back(moment_of(scene, loads, instant).angle_rad * 180 / pi);
    return degrees;
  };
  std::vector<double> safety;
  for (const double stress : envelope.von_mises.value_Pa)
    safety.push_back(stress > 0 ? std::min(analysis.scene.yield_strength_Pa / stress, 1e6) : 1e6);
  std::vector<std::int32_t> turn;
  for (const auto instant : envelope.von_mises.instant) turn.push_back(moment_of(scene, loads, instant).turn);

  Fields fields;
  fields.add_stress(von_mises_field, envelope.von_mises.value_Pa);
  fields.add("drive angle of maximum [deg]", angles(envelope.von_mises.instant));
  fields.add_tensor("stress at maximum [Pa]", flatten(envelope.von_mises.stress_Pa));
  fields.add("safety against yield", safety);
  fields.add_stress("largest principal stress, maximum [Pa]", envelope.principal.value_Pa);
  fields.add("drive angle of largest principal stress [deg]", angles(envelope.principal.instant));
  fields.add_tensor("stress at largest principal stress [Pa]", flatten(envelope.principal.stress_Pa));
  std::vector<double> shares(envelope.effect_share.begin(), envelope.effect_share.end());
  round_to(1.0 / 1024, shares);  // with all digits they would be a third of the file
  fields.add("effect share", std::move(shares), int(effects.size()), effects);
  if (!moved_m.empty()) fields.add_displacement("displacement at governing stress [m]", std::move(moved_m));
  if (auto beyond_m = beyond_left_out_m(nodes, analysis.places, analysis.mesh.sharp_edges); !beyond_m.empty())
    fields.add(beyond_field, std::move(beyond_m));
  if (analysis.fatigue) add_fatigue(fields, analysis);
  if (!analysis.hot_spots.empty()) fields.add_stress(hot_spot_field, hot_spot_values(analysis));
  auto marks = marked_faces(nodes, analysis.mesh);
  std::vector<IdField> ids{{"zone", analysis.zones.zone_of_node},
                           {"turn of maximum", turn},
                           {"instant of maximum", envelope.von_mises.instant},
                           excluded_ids(analysis.places),
                           surface_ids(nodes)};
  for (const auto& faces : marks.ids) ids.push_back(at_nodes(faces, nodes));
  const auto data = data_of(analysis, std::move(marks));
  if (n_pieces > 1)
    write_envelope_pieces(file, nodes, fem::shares_of_cells(nodes, n_pieces), n_pieces, fields.fields(), ids,
                          VtuCompression::zlib, data);
  else
    write_envelope_vtu(file, nodes, fields.fields(), ids, VtuCompression::zlib, data);
}

/// Where the body is when its governing stress occurs. Called on all ranks that share it.
std::vector<double> governing_displacement_m(const Judged& analysis) {
  return displacement_at(analysis.responses, analysis.loads.history, governing_stress(analysis).instant);
}

/// Copies the components of a node to its place among those of all nodes.
template <std::size_t n>
void put(const std::array<double, n>& components, std::size_t node, std::vector<double>& all) {
  std::copy(components.begin(), components.end(), all.begin() + std::ptrdiff_t(n * node));
}

/// Stress and displacement of the surface at one instant.
void write_snapshot(const path& file, const SurfaceSnapshots& files, const Superposed& analysis,
                    Eigen::Index instant) {
  const auto& responses = analysis.responses;
  const auto& loads = analysis.loads.history;
  const std::size_t n = responses.nodes.n;
  std::vector<double> von_mises(n), stress(6 * n), displacement(3 * n);
  for (const auto number : files.nodes()) {
    const auto node = std::size_t(number);
    if (!responses.has(node)) continue;
    const auto tensor = own_stress_at(responses, loads, node, instant);
    von_mises[node] = von_mises_Pa(tensor);
    put(tensor, node, stress);
    put(own_displacement_at(responses, loads, node, instant), node, displacement);
  }
  for (auto* values : {&von_mises, &stress, &displacement}) responses.complete(*values);
  if (!is_first_rank()) return;
  Fields fields;
  fields.add_stress("von Mises stress [Pa]", std::move(von_mises));
  fields.add_tensor("stress [Pa]", std::move(stress));
  fields.add_displacement("displacement [m]", std::move(displacement));
  files.write(file, fields.fields());
}

}  // namespace

std::string in_MPa(const std::string& field) {
  const std::string unit = "[Pa]";
  return field.substr(0, field.size() - unit.size()) + "[MPa]";
}

void write_envelope_files(const path& directory, const Scene& scene, const kinetics::LoadHistory& loads,
                          const Judged& analysis, int n_pieces) {
  auto moved_m = governing_displacement_m(analysis);
  if (is_first_rank())
    write_envelope(directory / (n_pieces > 1 ? "envelope.pvtu" : "envelope.vtu"), scene, loads, analysis,
                   n_pieces, std::move(moved_m));
}

void write_whole_envelope(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                          const Judged& analysis) {
  const bool is_shared = analysis.responses.shared != nullptr;
  write_envelope(file, scene, loads, analysis, 1,
                 is_shared ? std::vector<double>() : governing_displacement_m(analysis));
}

void write_cycle_files(const path& directory, const Scene& scene, const kinetics::LoadHistory& loads,
                       const Judged& analysis, int n_threads) {
  const Eigen::Index per_turn = scene.sampling.instants_per_turn;
  const Eigen::Index first = governing_stress(analysis).instant / per_turn * per_turn;
  std::vector<PvdEntry> entries;
  std::vector<Eigen::Index> instants;
  for (int s = 0; s < scene.snapshots; ++s) {
    char name[32];
    std::snprintf(name, sizeof name, "cycle_%03d.vtu", s);
    instants.push_back(first + per_turn * s / scene.snapshots);
    entries.push_back({loads.time_s[instants.back()], name, analysis.scene.name});
  }
  if (!entries.empty()) {
    auto [names, ids] = marked_faces(analysis.responses.nodes, analysis.mesh);
    ids.push_back(excluded_ids(analysis.places));
    const SurfaceSnapshots files(analysis.responses.nodes, std::move(ids), VtuCompression::lzma,
                                 std::move(names));
    const int at_once = threads_in_step(analysis.responses, n_threads);
    for_each_parallel(entries.size(), at_once, [&](std::size_t, std::size_t s) {
      write_snapshot(directory / entries[s].file, files, analysis, instants[s]);
    });
  }
  if (is_first_rank() && !entries.empty()) write_pvd(directory / "cycle.pvd", entries);
}

void write_bodies_together(const path& directory, const std::vector<std::string>& bodies, int n_pieces) {
  std::vector<VtmBlock> blocks;
  for (const auto& body : bodies) {
    blocks.push_back({body, {}});
    for (int piece = 0; piece < n_pieces; ++piece)
      blocks.back().files.push_back(
          path(body) / (n_pieces > 1 ? "envelope_" + std::to_string(piece) + ".vtu" : "envelope.vtu"));
  }
  write_vtm(directory / "bodies.vtm", blocks);
  write_text_file(directory / "paraview_view.py", paraview_script());
}

}  // namespace pipelines
