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
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/texts/moment.h"
#include "pipelines/write/exports/vtk_files.h"

namespace pipelines {
namespace {

using std::filesystem::path;

constexpr double not_converged = std::numeric_limits<double>::quiet_NaN();
const std::vector<std::string> names_of_components{"xx", "yy", "zz", "xy", "yz", "xz"};

std::vector<double> flatten(const std::vector<Stress>& tensors) {
  std::vector<double> values;
  values.reserve(tensors.size() * 6);
  for (const auto& tensor : tensors) values.insert(values.end(), tensor.begin(), tensor.end());
  return values;
}

bool some_excluded(const NodePlaces& places) {
  return std::any_of(places.excluded.begin(), places.excluded.end(), [](char c) { return c != 0; });
}

/// Fields with the values that they stand for.
class Fields {
public:
  explicit Fields(const NodePlaces& places) : places_(places) {}

  /// Adds a field, NaN at excluded nodes.
  void add_result(const std::string& name, std::vector<double> values, int n_components = 1,
                  const std::vector<std::string>& component_names = {}) {
    const auto n = std::size_t(n_components);
    for (std::size_t i = 0; i < places_.excluded.size(); ++i)
      if (places_.excluded[i]) std::fill_n(values.begin() + std::ptrdiff_t(i * n), n, not_converged);
    add(name, std::move(values), n_components, component_names);
  }
  /// The same, and the whole of it under a name that says what it is where nodes are excluded.
  void add_result_and_whole(const std::string& name, const std::vector<double>& values, int n_components = 1,
                            const std::vector<std::string>& component_names = {}) {
    add_result(name, values, n_components, component_names);
    if (some_excluded(places_)) add(unconverged(name), values, n_components, component_names);
  }
  void add(const std::string& name, std::vector<double> values, int n_components = 1,
           const std::vector<std::string>& component_names = {}) {
    values_.push_back(std::move(values));
    fields_.push_back(nodal_field(name, values_.back(), n_components, component_names));
  }
  const std::vector<NodalField>& fields() const { return fields_; }

private:
  const NodePlaces& places_;
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
  std::vector<double> values(analysis.responses.nodes.n, not_converged);
  for (const auto& spot : analysis.hot_spots)  // a corner may be the toe of several: the largest comes first
    if (auto& value = values[nearest_node(analysis.responses.nodes, spot.toe_m)]; std::isnan(value))
      value = spot.von_mises_Pa;
  return values;
}

/// Adds utilisation on the surface; NaN inside, where fatigue is not judged.
void add_fatigue(Fields& fields, const Judged& analysis) {
  const auto& fatigue = *analysis.fatigue;
  const std::size_t n = analysis.responses.nodes.n;
  std::vector<double> amplitude(n, not_converged), mean(n, not_converged), utilisation(n, not_converged);
  for (std::size_t i = 0; i < fatigue.cycles.nodes.size(); ++i) {
    const auto node = fatigue.cycles.nodes[i];
    amplitude[node] = fatigue.cycles.cycles[i].amplitude_Pa;
    mean[node] = fatigue.cycles.cycles[i].signed_mean_Pa;
    utilisation[node] = fatigue.utilisation_at[i];
  }
  fields.add_result("stress amplitude [Pa]", std::move(amplitude));
  fields.add_result("mean stress [Pa]", std::move(mean));
  fields.add_result("fatigue utilisation without support by gradient", std::move(utilisation));
}

FieldData governing_data(const Judged& analysis) {
  const auto stress = governing_stress(analysis);
  FieldData data;
  data.names = {{"governing stress, place", {stress.name() + " at " + stress.place}}};
  data.numbers = {{"governing stress [Pa]", {stress.value_Pa}},
                  {"governing stress, position [m]", {stress.position_m.begin(), stress.position_m.end()}}};
  return data;
}

/// Shares to 1e-5: with all digits they would be a third of the file.
std::vector<double> shown_shares(const std::vector<float>& shares) {
  constexpr double step = 1.0 / 65536;
  std::vector<double> shown;
  for (const double share : shares) shown.push_back(std::round(share / step) * step);
  return shown;
}

void write_envelope(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                    const Judged& analysis, int n_pieces) {
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

  Fields fields(analysis.places);
  fields.add_result_and_whole(von_mises_field, envelope.von_mises.value_Pa);
  fields.add_result("drive angle of maximum [deg]", angles(envelope.von_mises.instant));
  fields.add_result_and_whole("stress at maximum [Pa]", flatten(envelope.von_mises.stress_Pa), 6,
                              names_of_components);
  fields.add_result("safety against yield", safety);
  fields.add_result("largest principal stress, maximum [Pa]", envelope.principal.value_Pa);
  fields.add_result("drive angle of largest principal stress [deg]", angles(envelope.principal.instant));
  fields.add_result("stress at largest principal stress [Pa]", flatten(envelope.principal.stress_Pa), 6,
                    names_of_components);
  fields.add_result("effect share", shown_shares(envelope.effect_share), int(effects.size()), effects);
  if (auto beyond_m = beyond_left_out_m(nodes, analysis.places, analysis.mesh.sharp_edges); !beyond_m.empty())
    fields.add(beyond_field, std::move(beyond_m));
  if (analysis.fatigue) add_fatigue(fields, analysis);
  if (!analysis.hot_spots.empty()) fields.add(hot_spot_field, hot_spot_values(analysis));
  const std::vector<IdField> ids{{"zone", analysis.zones.zone_of_node},
                                 {"turn of maximum", turn},
                                 {"instant of maximum", envelope.von_mises.instant},
                                 excluded_ids(analysis.places),
                                 surface_ids(nodes)};
  const auto data = governing_data(analysis);
  if (n_pieces > 1)
    write_envelope_pieces(file, nodes, fem::shares_of_cells(nodes, n_pieces), n_pieces, fields.fields(), ids,
                          VtuCompression::zlib, data);
  else
    write_envelope_vtu(file, nodes, fields.fields(), ids, VtuCompression::zlib, data);
}

/// Stress and displacement of the surface at one instant.
void write_snapshot(const path& file, const SurfaceSnapshots& files, const Superposed& analysis,
                    Eigen::Index instant) {
  const auto& responses = analysis.responses;
  const auto& loads = analysis.loads.history;
  std::vector<double> von_mises(responses.nodes.n), displacement(3 * responses.nodes.n);
  for (const auto number : files.nodes()) {
    const auto node = std::size_t(number);
    if (!responses.has(node)) continue;
    von_mises[node] = von_mises_Pa(own_stress_at(responses, loads, node, instant));
    const auto moved_m = own_displacement_at(responses, loads, node, instant);
    std::copy(moved_m.begin(), moved_m.end(), displacement.begin() + std::ptrdiff_t(3 * node));
  }
  responses.complete(von_mises);
  responses.complete(displacement);
  if (!is_first_rank()) return;
  Fields fields(analysis.places);
  fields.add_result_and_whole("von Mises stress [Pa]", von_mises);
  fields.add("displacement [m]", std::move(displacement), 3, {"x", "y", "z"});
  files.write(file, fields.fields());
}

}  // namespace

std::string unconverged(const std::string& field) {
  return "not converged where excluded: " + field;
}

std::string pictured_field(const Superposed& analysis) {
  return some_excluded(analysis.places) ? unconverged(von_mises_field) : von_mises_field;
}

void write_envelope_files(const path& directory, const Scene& scene, const kinetics::LoadHistory& loads,
                          const Judged& analysis, int n_pieces) {
  write_envelope(directory / (n_pieces > 1 ? "envelope.pvtu" : "envelope.vtu"), scene, loads, analysis,
                 n_pieces);
}

void write_whole_envelope(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                          const Judged& analysis) {
  write_envelope(file, scene, loads, analysis, 1);
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
    const SurfaceSnapshots files(analysis.responses.nodes, {excluded_ids(analysis.places)});
    const int at_once = threads_in_step(analysis.responses, n_threads);
    for_each_parallel(entries.size(), at_once, [&](std::size_t, std::size_t s) {
      write_snapshot(directory / entries[s].file, files, analysis, instants[s]);
    });
  }
  if (is_first_rank() && !entries.empty()) write_pvd(directory / "cycle.pvd", entries);
}

}  // namespace pipelines
