#include "pipelines/write/files/results.h"

#include "meshes/gmsh/msh_writer.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/write/fields/zone_fields.h"
#include "pipelines/write/files/envelope_files.h"
#include "pipelines/write/parts/fatigue_report.h"
#include "pipelines/write/parts/shaft_torsion_report.h"

namespace pipelines {
namespace {

using std::filesystem::path;

/// Every zone with its parts below it, at the levels that they are above.
std::vector<ZonePart> zone_tree(const Zones& zones) {
  std::vector<ZonePart> rows;
  for (const auto& zone : zones.zones) {
    ZonePart whole;
    whole.number = std::to_string(&zone - zones.zones.data() + 1);
    whole.level_Pa = zones.level_Pa;
    whole.peak_Pa = zone.peak_Pa;
    whole.peak_m = zone.peak_m;
    whole.instant = zone.instant;
    whole.n_nodes = zone.n_nodes;
    whole.feature = zone.feature;
    whole.place = zone.place;
    rows.push_back(std::move(whole));
    rows.insert(rows.end(), zone.parts.begin(), zone.parts.end());
  }
  return rows;
}

/// Whirl frequencies over the speed of the shaft: as many of each mode as there are at all speeds.
void write_campbell(const path& file, const CriticalSpeeds& speeds) {
  std::vector<CsvColumn> columns{{"speed", "rad/s", speeds.campbell_rad_s}};
  for (const auto& [name, list] : {std::pair("forward", &fem::WhirlFrequencies::forward_rad_s),
                                   {"backward", &fem::WhirlFrequencies::backward_rad_s}})
    for (std::size_t mode = 0; mode < (speeds.campbell_whirl.front().*list).size(); ++mode) {
      std::vector<double> whirl_rad_s;
      for (const auto& at_speed : speeds.campbell_whirl) whirl_rad_s.push_back((at_speed.*list)[mode]);
      columns.push_back({name + (" " + std::to_string(mode + 1)), "rad/s", whirl_rad_s});
    }
  write_csv(file, columns);
}

}  // namespace

void write_mesh(const path& file, const meshes::BodyMesh& mesh) {
  AtomicFile target(file);
  meshes::write_msh(mesh, target.temporary());
  target.commit("$EndElements\n");  // gmsh does not tell that the disk was full
}

void write_body_results(const path& directory, const Scene& scene, const kinetics::LoadHistory& loads,
                        const Judged& analysis, int n_pieces, int n_threads) {
  if (is_first_rank() && analysis.method == Method::solid) write_mesh(directory / "mesh.msh", analysis.mesh);
  write_envelope_files(directory, scene, loads, analysis, n_pieces);
  write_cycle_files(directory, scene, loads, analysis, n_threads);
  if (!is_first_rank()) return;
  const BodyResult body{scene, loads, analysis};
  write_rows(directory / "zones.csv", zone_fields(), body, analysis.zones.zones);
  write_rows(directory / "zone_tree.csv", zone_part_fields(), body, zone_tree(analysis.zones));
  if (!analysis.hot_spots.empty())
    write_rows(directory / "hot_spots.csv", hot_spot_fields(), body, analysis.hot_spots);
  if (analysis.fatigue && !analysis.fatigue->welds.empty())
    write_weld_fatigue(directory / "weld_fatigue.csv", body);
  if (analysis.fatigue) write_fatigue(directory / "fatigue.csv", body);
  if (analysis.critical_speeds) write_campbell(directory / "campbell.csv", *analysis.critical_speeds);
  if (analysis.start_up) write_start_up(directory / "start_up.csv", analysis);
  if (!analysis.diagrams) return;
  write_element_torsion(directory / "element_torques.csv", loads, analysis);
  write_diagrams(directory / "diagrams.csv", analysis);
  write_torsion(directory, loads, analysis);
}

}  // namespace pipelines
