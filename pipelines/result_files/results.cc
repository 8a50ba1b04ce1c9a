#include "pipelines/result_files/results.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>

#include "meshes/gmsh/msh_writer.h"
#include "pipelines/analysis/governing_stress.h"
#include "pipelines/channels/load_files.h"
#include "pipelines/common/constants.h"
#include "pipelines/common/several_ranks.h"
#include "pipelines/common/statistics.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/files/csv.h"
#include "pipelines/report_parts/fatigue_report.h"
#include "pipelines/report_parts/moment.h"
#include "pipelines/report_parts/shaft_torsion_report.h"
#include "pipelines/result_files/envelope_files.h"

namespace pipelines {
namespace {

using std::filesystem::path;

const std::vector<std::string> tensor_components{"xx", "yy", "zz", "xy", "yz", "xz"};

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
  columns.push_back(column("peak_error", "Pa", zones, [&](const Zone& z) {
    const auto error = error_Pa(analysis, z);
    return error ? shortest(*error) : std::string();
  }));
  columns.push_back(column("safety_against_yield", "", zones, [](const Zone& z) { return z.safety; }));
  columns.push_back(
      column("turn", "", zones, [&](const Zone& z) { return moment_of(scene, loads, z.instant).turn; }));
  columns.push_back(column("drive_angle", "rad", zones,
                           [&](const Zone& z) { return moment_of(scene, loads, z.instant).angle_rad; }));
  for (std::size_t c = 0; c < 3; ++c)
    columns.push_back(
        column(std::string(1, "xyz"[c]), "m", zones, [&](const Zone& z) { return z.peak_m[c]; }));
  columns.push_back(column("volume", "m3", zones, [](const Zone& z) {
    return std::isfinite(z.volume_m3) ? shortest(z.volume_m3) : std::string();
  }));
  columns.push_back(column("volume_error", "m3", zones, [](const Zone& z) {
    return z.volume_error_m3 ? shortest(*z.volume_error_m3) : std::string();
  }));
  columns.push_back(column("nodes", "", zones, [](const Zone& z) { return std::int64_t(z.n_nodes); }));
  for (std::size_t c = 0; c < 6; ++c)
    columns.push_back(
        column("sigma_" + tensor_components[c], "Pa", zones, [&](const Zone& z) { return z.stress_Pa[c]; }));
  write_csv(file, columns);
}

/// Every zone with its parts below it, at the levels that they are above.
void write_zone_tree(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                     const BodyAnalysis& analysis) {
  std::vector<ZonePart> rows;
  for (const auto& zone : analysis.zones.zones) {
    ZonePart whole;
    whole.number = std::to_string(&zone - analysis.zones.zones.data() + 1);
    whole.level_Pa = analysis.zones.level_Pa;
    whole.peak_Pa = zone.peak_Pa;
    whole.peak_m = zone.peak_m;
    whole.instant = zone.instant;
    whole.n_nodes = zone.n_nodes;
    whole.feature = zone.feature;
    whole.place = zone.place;
    rows.push_back(std::move(whole));
    rows.insert(rows.end(), zone.parts.begin(), zone.parts.end());
  }
  std::vector<CsvColumn> columns;
  columns.push_back(column("zone", "", rows, [](const ZonePart& p) { return p.number; }));
  columns.push_back(column("level", "Pa", rows, [](const ZonePart& p) { return p.level_Pa; }));
  columns.push_back(column("feature", "", rows, [](const ZonePart& p) { return p.feature; }));
  columns.push_back(column("place", "", rows, [](const ZonePart& p) { return to_string(p.place); }));
  columns.push_back(column("peak_von_mises", "Pa", rows, [](const ZonePart& p) { return p.peak_Pa; }));
  columns.push_back(
      column("turn", "", rows, [&](const ZonePart& p) { return moment_of(scene, loads, p.instant).turn; }));
  columns.push_back(column("drive_angle", "rad", rows,
                           [&](const ZonePart& p) { return moment_of(scene, loads, p.instant).angle_rad; }));
  for (std::size_t c = 0; c < 3; ++c)
    columns.push_back(
        column(std::string(1, "xyz"[c]), "m", rows, [&](const ZonePart& p) { return p.peak_m[c]; }));
  columns.push_back(column("nodes", "", rows, [](const ZonePart& p) { return std::int64_t(p.n_nodes); }));
  write_csv(file, columns);
}

void write_hot_spots(const path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                     const BodyAnalysis& analysis) {
  const auto& spots = analysis.hot_spots;
  std::vector<CsvColumn> columns;
  columns.push_back(column("hot_spot", "", spots, [](const HotSpotStress& h) { return h.name; }));
  columns.push_back(
      column("von_mises_max", "Pa", spots, [](const HotSpotStress& h) { return h.von_mises_Pa; }));
  columns.push_back(
      column("von_mises_error", "Pa", spots, [&](const HotSpotStress& h) { return error_Pa(analysis, h); }));
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

void write_load_results(const path& directory, const kinetics::LoadHistory& loads, const BodyChannels& bodies,
                        int n_threads) {
  const auto policy = n_threads > 1 ? std::launch::async : std::launch::deferred;
  auto csv =
      std::async(policy, [&] { write_loads_csv(directory / "loads.csv", loads, bodies, n_threads - 1); });
  write_loads_h5(directory / "loads.h5", loads, bodies);
  csv.get();
}

void write_mesh(const path& file, const meshes::BodyMesh& mesh) {
  AtomicFile target(file);
  meshes::write_msh(mesh, target.temporary());
  target.commit("$EndElements\n");  // gmsh does not tell that the disk was full
}

void write_body_results(const path& directory, const Scene& scene, const kinetics::LoadHistory& loads,
                        const BodyAnalysis& analysis, int n_pieces, int n_threads) {
  if (is_first_rank()) {
    if (analysis.method == Method::solid) write_mesh(directory / "mesh.msh", analysis.mesh);
    write_envelope_files(directory, scene, loads, analysis, n_pieces);
  }
  write_cycle_files(directory, scene, loads, analysis, n_threads);
  if (!is_first_rank()) return;
  write_zones(directory / "zones.csv", scene, loads, analysis);
  write_zone_tree(directory / "zone_tree.csv", scene, loads, analysis);
  if (!analysis.hot_spots.empty()) write_hot_spots(directory / "hot_spots.csv", scene, loads, analysis);
  if (analysis.fatigue && !analysis.fatigue->welds.empty())
    write_weld_fatigue(directory / "weld_fatigue.csv", analysis);
  if (analysis.fatigue) write_fatigue(directory / "fatigue.csv", scene, loads, analysis);
  if (analysis.start_up) write_start_up(directory / "start_up.csv", analysis);
  if (!analysis.diagrams) return;
  write_element_torsion(directory / "element_torques.csv", loads, analysis);
  write_diagrams(directory / "diagrams.csv", analysis);
  write_torsion(directory, loads, analysis);
}

}  // namespace pipelines
