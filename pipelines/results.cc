#include "pipelines/results.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "fem/cell_shares.h"
#include "pipelines/csv.h"
#include "pipelines/load_files.h"
#include "pipelines/statistics.h"
#include "pipelines/vtk_files.h"

namespace pipelines {
namespace {

using std::filesystem::path;

const std::vector<std::string> tensor_components{"xx", "yy", "zz", "xy", "yz", "xz"};

std::vector<double> flatten(const std::vector<Stress>& tensors) {
  std::vector<double> values;
  values.reserve(tensors.size() * 6);
  for (const auto& tensor : tensors) values.insert(values.end(), tensor.begin(), tensor.end());
  return values;
}

/// What an earlier run on another number of ranks has left.
void remove_other_envelopes(const path& directory, int n_pieces) {
  if (n_pieces > 1)
    std::filesystem::remove(directory / "envelope.vtu");
  else
    std::filesystem::remove(directory / "envelope.pvtu");
  for (int piece = n_pieces > 1 ? n_pieces : 0;; ++piece)
    if (!std::filesystem::remove(directory / ("envelope_" + std::to_string(piece) + ".vtu"))) return;
}

void write_envelope(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                    const BodyAnalysis& analysis, int n_pieces) {
  const auto& nodes = analysis.responses.nodes;
  const auto& envelope = analysis.envelope;
  const auto& effects = analysis.loads.history.effects;
  const auto angles = [&](const std::vector<std::int32_t>& instants) {
    std::vector<double> degrees;
    for (const auto instant : instants)
      degrees.push_back(moment_of(scene, loads, instant).angle_rad * 180 / M_PI);
    return degrees;
  };
  const auto angle_v = angles(envelope.von_mises.instant), angle_1 = angles(envelope.principal.instant);
  const auto tensor_v = flatten(envelope.von_mises.stress_Pa),
             tensor_1 = flatten(envelope.principal.stress_Pa);
  std::vector<double> safety;
  for (const double stress : envelope.von_mises.value_Pa)
    safety.push_back(stress > 0 ? std::min(analysis.scene.yield_strength_Pa / stress, 1e6) : 1e6);
  std::vector<std::int32_t> turn;
  for (const auto instant : envelope.von_mises.instant) turn.push_back(moment_of(scene, loads, instant).turn);

  std::vector<NodalField> fields{
      nodal_field("von Mises stress, maximum [Pa]", envelope.von_mises.value_Pa),
      nodal_field("drive angle of maximum [deg]", angle_v),
      nodal_field("stress at maximum [Pa]", tensor_v, 6, tensor_components),
      nodal_field("safety against yield", safety),
      nodal_field("largest principal stress, maximum [Pa]", envelope.principal.value_Pa),
      nodal_field("drive angle of largest principal stress [deg]", angle_1),
      nodal_field("stress at largest principal stress [Pa]", tensor_1, 6, tensor_components),
      nodal_field("effect share", envelope.effect_share, int(effects.size()), effects)};
  const std::vector<IdField> ids{{"zone", analysis.zones.zone_of_node},
                                 {"turn of maximum", turn},
                                 {"instant of maximum", envelope.von_mises.instant},
                                 {"excluded", std::vector<std::int32_t>(analysis.places.excluded.begin(),
                                                                        analysis.places.excluded.end())}};
  if (n_pieces > 1)
    write_envelope_pieces(file, nodes, fem::shares_of_cells(nodes, n_pieces), n_pieces, fields, ids);
  else
    write_envelope_vtu(file, nodes, fields, ids);
}

/// What an earlier run with other snapshots has left, so that the folder shows one run.
void remove_other_snapshots(const path& directory, const std::vector<PvdEntry>& kept) {
  std::vector<path> strangers;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const auto name = entry.path().filename();
    const bool snapshot = name.string().rfind("cycle_", 0) == 0 && name.extension() == ".vtu";
    const bool listed = std::any_of(kept.begin(), kept.end(), [&](const auto& k) { return k.file == name; });
    if ((snapshot && !listed) || (kept.empty() && name == "cycle.pvd")) strangers.push_back(entry.path());
  }
  for (const auto& stranger : strangers) std::filesystem::remove(stranger);
}

void write_cycle(const path& directory, const Scene& scene, const kinetics::LoadHistory& loads,
                 const BodyAnalysis& analysis) {
  const Eigen::Index per_turn = scene.sampling.instants_per_turn;
  const Eigen::Index first = analysis.peak.instant / per_turn * per_turn;
  std::vector<PvdEntry> entries;
  std::vector<double> von_mises(analysis.responses.nodes.n);
  for (int s = 0; s < scene.snapshots; ++s) {
    const Eigen::Index instant = first + per_turn * s / scene.snapshots;
    for (std::size_t node = 0; node < von_mises.size(); ++node)
      von_mises[node] = von_mises_Pa(stress_at(analysis.responses, analysis.loads.history, node, instant));
    const auto displacement = displacement_at(analysis.responses, analysis.loads.history, instant);
    char name[32];
    std::snprintf(name, sizeof name, "cycle_%03d.vtu", s);
    write_surface_snapshot_vtu(directory / name, analysis.responses.nodes,
                               {nodal_field("von Mises stress [Pa]", von_mises),
                                nodal_field("displacement [m]", displacement, 3, {"x", "y", "z"})});
    entries.push_back({loads.time_s[instant], name, analysis.scene.name});
  }
  if (!entries.empty()) write_pvd(directory / "cycle.pvd", entries);
  remove_other_snapshots(directory, entries);
}

/// One column over a list of things.
template <typename List, typename Get>
CsvColumn column(std::string name, std::string unit, const List& list, Get&& get) {
  using Value = std::decay_t<decltype(get(list.front()))>;
  using Cell = std::conditional_t<std::is_convertible_v<Value, std::string>, std::string,
                                  std::conditional_t<std::is_integral_v<Value>, std::int64_t, double>>;
  std::vector<Cell> cells;
  for (const auto& entry : list) cells.push_back(Cell(get(entry)));
  return {std::move(name), std::move(unit), std::move(cells)};
}

void write_zones(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                 const BodyAnalysis& analysis) {
  const auto& zones = analysis.zones.zones;
  std::vector<CsvColumn> columns;
  std::int64_t rank = 0;
  columns.push_back(column("zone", "", zones, [&](const Zone&) { return ++rank; }));
  columns.push_back(column("feature", "", zones, [](const Zone& z) { return z.feature; }));
  columns.push_back(column("place", "", zones, [](const Zone& z) { return to_string(z.place); }));
  columns.push_back(column("peak_von_mises", "Pa", zones, [](const Zone& z) { return z.peak_Pa; }));
  columns.push_back(column("safety_against_yield", "", zones, [](const Zone& z) { return z.safety; }));
  columns.push_back(
      column("turn", "", zones, [&](const Zone& z) { return moment_of(scene, loads, z.instant).turn; }));
  columns.push_back(column("drive_angle", "rad", zones,
                           [&](const Zone& z) { return moment_of(scene, loads, z.instant).angle_rad; }));
  for (std::size_t c = 0; c < 3; ++c)
    columns.push_back(
        column(std::string(1, "xyz"[c]), "m", zones, [&](const Zone& z) { return z.peak_m[c]; }));
  columns.push_back(column("volume", "m3", zones, [](const Zone& z) { return z.volume_m3; }));
  columns.push_back(column("nodes", "", zones, [](const Zone& z) { return std::int64_t(z.n_nodes); }));
  for (std::size_t c = 0; c < 6; ++c)
    columns.push_back(
        column("sigma_" + tensor_components[c], "Pa", zones, [&](const Zone& z) { return z.stress_Pa[c]; }));
  write_csv(file, columns);
}

void write_hot_spots(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                     const BodyAnalysis& analysis) {
  const auto& spots = analysis.hot_spots;
  std::vector<CsvColumn> columns;
  columns.push_back(column("hot_spot", "", spots, [](const HotSpotStress& h) { return h.name; }));
  columns.push_back(
      column("von_mises_max", "Pa", spots, [](const HotSpotStress& h) { return h.von_mises_Pa; }));
  columns.push_back(column("turn", "", spots,
                           [&](const HotSpotStress& h) { return moment_of(scene, loads, h.instant).turn; }));
  columns.push_back(column("drive_angle", "rad", spots, [&](const HotSpotStress& h) {
    return moment_of(scene, loads, h.instant).angle_rad;
  }));
  columns.push_back(
      column("normal_max", "Pa", spots, [](const HotSpotStress& h) { return h.max_normal_Pa; }));
  columns.push_back(
      column("normal_min", "Pa", spots, [](const HotSpotStress& h) { return h.min_normal_Pa; }));
  columns.push_back(column("normal_range", "Pa", spots,
                           [](const HotSpotStress& h) { return h.max_normal_Pa - h.min_normal_Pa; }));
  for (std::size_t c = 0; c < 3; ++c)
    columns.push_back(
        column(std::string(1, "xyz"[c]), "m", spots, [&](const HotSpotStress& h) { return h.toe_m[c]; }));
  write_csv(file, columns);
}

/// Largest over the cycle of the length of rows (r, r + 1).
double largest_pair(const SectionHistory& history, Eigen::Index row) {
  return history.middleRows<2>(row).matrix().colwise().stableNorm().maxCoeff();
}

void write_diagrams(const path& file, const BodyAnalysis& analysis) {
  const auto& sections = analysis.diagrams->sections;
  const auto instant = analysis.peak.instant;
  std::vector<CsvColumn> columns;
  columns.push_back(column("z", "m", sections, [](const auto& s) { return s.plane.z_m; }));
  columns.push_back(column("segment", "", sections, [](const auto& s) { return s.plane.segment; }));
  columns.push_back(column("diameter", "m", sections, [](const auto& s) { return 2 * s.plane.radius_m; }));
  columns.push_back(
      column("N_max", "N", sections, [](const auto& s) { return s.by_stress.row(2).abs().maxCoeff(); }));
  columns.push_back(
      column("V_max", "N", sections, [](const auto& s) { return largest_pair(s.by_stress, 0); }));
  columns.push_back(
      column("M_max", "N m", sections, [](const auto& s) { return largest_pair(s.by_stress, 3); }));
  columns.push_back(
      column("T_max", "N m", sections, [](const auto& s) { return s.by_stress.row(5).maxCoeff(); }));
  columns.push_back(
      column("T_min", "N m", sections, [](const auto& s) { return s.by_stress.row(5).minCoeff(); }));
  columns.push_back(
      column("V_max_statics", "N", sections, [](const auto& s) { return largest_pair(s.by_statics, 0); }));
  columns.push_back(
      column("M_max_statics", "N m", sections, [](const auto& s) { return largest_pair(s.by_statics, 3); }));
  columns.push_back(
      column("T_max_statics", "N m", sections, [](const auto& s) { return s.by_statics.row(5).maxCoeff(); }));
  columns.push_back(
      column("T_min_statics", "N m", sections, [](const auto& s) { return s.by_statics.row(5).minCoeff(); }));
  columns.push_back(column("deflection_max", "m", sections, [](const auto& s) {
    return s.deflection_m.matrix().colwise().stableNorm().maxCoeff();
  }));
  columns.push_back(column("slope_max", "rad", sections, [](const auto& s) {
    return s.slope_rad.matrix().colwise().stableNorm().maxCoeff();
  }));
  const std::vector<std::string> names{"Vx", "Vy", "N", "Mx", "My", "T"};
  for (std::size_t c = 0; c < 6; ++c)
    columns.push_back(column(names[c] + "_at_peak", c < 3 ? "N" : "N m", sections,
                             [&](const auto& s) { return double(s.by_stress(Eigen::Index(c), instant)); }));
  columns.push_back(column("deflection_x_at_peak", "m", sections,
                           [&](const auto& s) { return double(s.deflection_m(0, instant)); }));
  columns.push_back(column("deflection_y_at_peak", "m", sections,
                           [&](const auto& s) { return double(s.deflection_m(1, instant)); }));
  write_csv(file, columns);
}

void write_torsion(const path& directory, const kinetics::LoadHistory& loads, const BodyAnalysis& analysis) {
  const auto& sections = analysis.diagrams->sections;
  std::vector<CsvColumn> columns;
  const auto over = [&](const std::string& name, const std::string& unit,
                        const std::function<const Eigen::ArrayXd(const SectionResult&)>& series) {
    columns.push_back(
        column(name + "_max", unit, sections, [&](const auto& s) { return series(s).maxCoeff(); }));
    columns.push_back(
        column(name + "_min", unit, sections, [&](const auto& s) { return series(s).minCoeff(); }));
    columns.push_back(
        column(name + "_mean", unit, sections, [&](const auto& s) { return series(s).mean(); }));
    columns.push_back(
        column(name + "_rms", unit, sections, [&](const auto& s) { return root_mean_square(series(s)); }));
  };
  columns.push_back(column("z", "m", sections, [](const auto& s) { return s.plane.z_m; }));
  columns.push_back(column("segment", "", sections, [](const auto& s) { return s.plane.segment; }));
  columns.push_back(column("diameter", "m", sections, [](const auto& s) { return 2 * s.plane.radius_m; }));
  columns.push_back(column("plain", "", sections, [](const auto& s) { return std::int64_t(s.plane.plain); }));
  over("torque", "N m",
       [](const SectionResult& s) -> Eigen::ArrayXd { return s.by_stress.row(5).transpose(); });
  over("torsional_stress", "Pa", [](const SectionResult& s) { return s.torsion_Pa; });
  over("torsional_stress_beam", "Pa", [](const SectionResult& s) { return s.beam_torsion_Pa; });
  write_csv(directory / "torsion.csv", columns);

  // Over the cycle: at the middle one of the sections of each segment.
  std::vector<CsvColumn> cycle;
  const auto series = [](const Eigen::ArrayXd& values) {
    return std::vector<double>(values.data(), values.data() + values.size());
  };
  cycle.push_back({"time", "s", series(loads.time_s)});
  cycle.push_back({"phi", "rad", series(loads.phi_rad)});
  for (std::size_t begin = 0; begin < sections.size();) {
    std::size_t end = begin;
    while (end < sections.size() && sections[end].plane.segment == sections[begin].plane.segment) ++end;
    const auto& middle = sections[(begin + end) / 2];
    cycle.push_back({middle.plane.segment + ".torque", "N m", series(middle.by_stress.row(5).transpose())});
    cycle.push_back({middle.plane.segment + ".torsional_stress", "Pa", series(middle.torsion_Pa)});
    begin = end;
  }
  write_csv(directory / "torsion_cycle.csv", cycle);
}

}  // namespace

Moment moment_of(const Scene& scene, const kinetics::LoadHistory& loads, Eigen::Index instant) {
  double angle = std::remainder(loads.phi_rad[instant] - M_PI, 2 * M_PI) + M_PI;
  if (angle > 2 * M_PI - 1e-9) angle = 0;  // a whole turn that rounding leaves short of itself
  return {int(instant / scene.sampling.instants_per_turn) + 1, angle};
}

void write_load_results(const path& directory, const kinetics::LoadHistory& loads,
                        const BodyChannels& bodies) {
  write_loads_h5(directory / "loads.h5", loads, bodies);
  write_loads_csv(directory / "loads.csv", loads, bodies);
}

void write_body_results(const path& directory, const Scene& scene, const kinetics::LoadHistory& loads,
                        const BodyAnalysis& analysis, int n_pieces) {
  write_envelope(directory / (n_pieces > 1 ? "envelope.pvtu" : "envelope.vtu"), scene, loads, analysis,
                 n_pieces);
  remove_other_envelopes(directory, n_pieces);
  write_cycle(directory, scene, loads, analysis);
  write_zones(directory / "zones.csv", scene, loads, analysis);
  if (!analysis.hot_spots.empty()) write_hot_spots(directory / "hot_spots.csv", scene, loads, analysis);
  if (!analysis.diagrams) return;
  write_diagrams(directory / "diagrams.csv", analysis);
  write_torsion(directory, loads, analysis);
}

void write_whole_envelope(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                          const BodyAnalysis& analysis) {
  write_envelope(file, scene, loads, analysis, 1);
}

}  // namespace pipelines
