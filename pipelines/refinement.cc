#include "pipelines/refinement.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipelines/fineness.h"

namespace pipelines {
namespace {

constexpr std::array<int, 9> cells_on_quarters = {2, 6, 8, 12, 16, 24, 32, 48, 64};
constexpr double coarser_start = 1 / 1.5, step_factor = 1.5;
constexpr double toe_step = 2, other_toes_step = 1.1, elsewhere_step = 1.05, toe_order = 1;
/// Entries that large beside the largest one are mended in the same step.
constexpr double mended_along = 1.0 / 3;
constexpr int most_pressure_harmonics = 64;
constexpr double smallest_exponent = 0.1, kept_exponent = 0.75;
constexpr double spot_shrinkage = 0.6, spot_radius_cells = 3;

int next_cells(int cells) {
  const auto next = std::upper_bound(cells_on_quarters.begin(), cells_on_quarters.end(), cells);
  return next == cells_on_quarters.end() ? cells : *next;
}

/// Index among the shaft's fillets of each one that may hold the peak, by its own stress and error.
std::vector<std::size_t> fillets_that_may_lead(const BodyAnalysis& analysis, double leading_Pa) {
  const auto names = fillets_of(analysis.scene);
  const auto& places = analysis.places;
  const auto& maximum = analysis.envelope.von_mises;
  std::vector<std::size_t> result;
  for (std::size_t f = 0; f < names.size(); ++f) {
    const auto feature = std::find(places.feature_names.begin(), places.feature_names.end(), names[f]);
    if (names[f].empty() || feature == places.feature_names.end()) continue;
    const auto index = std::int32_t(feature - places.feature_names.begin());
    std::size_t node = maximum.value_Pa.size();
    for (std::size_t i = 0; i < maximum.value_Pa.size(); ++i)
      if (places.feature[i] == index && !places.excluded[i] &&
          (node == maximum.value_Pa.size() || maximum.value_Pa[i] > maximum.value_Pa[node]))
        node = i;
    if (node == maximum.value_Pa.size()) continue;
    const auto errors = self_estimate({{{node, 1.0}}, maximum.instant[node]}, analysis.responses,
                                      analysis.loads, analysis.scene.material, 0);
    if (maximum.value_Pa[node] + errors.of("discretisation") >= leading_Pa) result.push_back(f);
  }
  return result;
}

/// Whether cells are half or twice as large away from the toes moves the hot-spot stress of a tube by 1 %, at
/// the toes by 4 %, through the wall, beside them, by 3 %.
Refinement refine_chamber(BodyScene& body, const BodyAnalysis& analysis) {
  const auto before = std::get<ChamberShape>(body.shape).mesh;
  body = with_fineness(body, elsewhere_step);
  auto& mesh = std::get<ChamberShape>(body.shape).mesh;
  mesh.cells_through_wall = before.cells_through_wall + 1;
  mesh.toe_walls = before.toe_walls / other_toes_step;
  mesh.fine_toes = before.fine_toes;
  const double relative_error = governing_stress(analysis).relative_error();
  for (const auto& spot : analysis.hot_spots) {
    if (spot.von_mises_Pa * (1 + relative_error) < analysis.hot_spots.front().von_mises_Pa) continue;
    const auto same = [&](const meshes::FineToe& toe) { return toe.at_m == spot.toe_m; };
    const auto fine = std::find_if(mesh.fine_toes.begin(), mesh.fine_toes.end(), same);
    if (fine != mesh.fine_toes.end())
      fine->walls /= toe_step;
    else
      mesh.fine_toes.push_back({spot.toe_m, before.toe_walls / toe_step});
  }
  return {true, true, toe_step, toe_order};
}

Refinement refine_shaft(BodyScene& body, const BodyAnalysis& analysis, const Remainders& known) {
  auto& mesh = std::get<ShaftShape>(body.shape).mesh;
  const bool on_fillet = analysis.peak.feature.rfind("fillet ", 0) == 0;
  const auto leading = fillets_that_may_lead(analysis, analysis.peak.value_Pa);
  const bool can_be_finer = std::any_of(leading.begin(), leading.end(), [&](std::size_t f) {
    return next_cells(mesh.cells_at(int(f))) > mesh.cells_at(int(f));
  });
  if (!on_fillet || !can_be_finer || known.next() == MeshPart::around) {
    mesh.n_sectors = with_fineness(body, step_factor).shaft()->mesh.n_sectors;
    mesh.growth /= step_factor;
    mesh.largest_cell_m /= step_factor;
    return {true, true, step_factor, 2, MeshPart::around};
  }
  mesh.fillet_cells.resize(fillets_of(body).size(), 0);
  double ratio = 1;
  for (const auto f : leading) {
    const int before = mesh.cells_at(int(f)), after = next_cells(before);
    mesh.fillet_cells[f] = after;
    ratio = std::max(ratio, double(after) / before);
  }
  return {true, true, ratio, 2, MeshPart::fillets};
}

/// Mean edge of the cells around a node.
double cell_size_m(const fem::Nodes& nodes, std::size_t node) {
  double sum_m = 0;
  int n = 0;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::find(cell.begin(), cell.end(), std::int32_t(node)) == cell.end()) continue;
    for (int i = 0; i < 4; ++i)  // corners of a tetrahedron
      for (int j = 0; j < i; ++j, ++n) {
        const double* a = &nodes.xyz_m[3 * std::size_t(cell[std::size_t(i)])];
        const double* b = &nodes.xyz_m[3 * std::size_t(cell[std::size_t(j)])];
        sum_m += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      }
  }
  return n > 0 ? sum_m / n : 0;
}

Refinement refine_solid(BodyScene& body, const BodyAnalysis& analysis) {
  auto* shaft = std::get_if<ShaftShape>(&body.shape);
  auto& control = shaft ? shaft->solid : std::get<meshes::Import>(body.shape).control;
  const double size_m = cell_size_m(analysis.responses.nodes, analysis.peak.node);
  if (!can_be_refined(body) || size_m == 0) return {};
  control.fine_spots.push_back(
      {analysis.peak.position_m, spot_radius_cells * size_m, spot_shrinkage * size_m});
  control.smallest_size_m = std::min(control.smallest_size_m, spot_shrinkage * size_m);
  return {true, true, 1 / spot_shrinkage};
}

}  // namespace

GoverningStress governing_stress(const BodyAnalysis& analysis) {
  if (analysis.hot_spots.empty())
    return {"peak von Mises stress", analysis.peak.feature, analysis.peak.value_Pa, analysis.peak.errors};
  const auto& spot = analysis.hot_spots.front();
  return {"hot-spot stress", spot.name, spot.von_mises_Pa, analysis.hot_spot_errors};
}

void Remainders::learn(MeshPart part, double missing_Pa) {
  if (part == MeshPart::fillets) {
    fillets_Pa = missing_Pa;
    ++n_fillet_steps;
  }
  if (part == MeshPart::around) around_Pa = missing_Pa;
}

double Remainders::of_others(MeshPart part) const {
  if (part == MeshPart::fillets) return around_Pa.value_or(0);
  return part == MeshPart::around ? fillets_Pa.value_or(0) : 0;
}

MeshPart Remainders::next() const {
  if (n_fillet_steps < 2) return MeshPart::fillets;
  return !around_Pa || *around_Pa > *fillets_Pa ? MeshPart::around : MeshPart::fillets;
}

BodyScene coarsest(const BodyScene& body) {
  BodyScene result = body;
  auto* shaft = std::get_if<ShaftShape>(&result.shape);
  if (shaft == nullptr || !shaft->keyways.empty()) return with_fineness(body, coarser_start);
  shaft->mesh.cells_per_fillet_quarter = 2;
  shaft->mesh.fillet_cells.clear();
  shaft->mesh.n_sectors = 8;
  return result;
}

Refinement refine(Scene& scene, std::size_t index, const BodyAnalysis& analysis, const Remainders& known) {
  BodyScene& body = scene.bodies[index];
  const auto ledger = governing_stress(analysis).errors;
  const double discretisation = ledger.of("discretisation") + ledger.of("geometry");
  const double harmonics = ledger.of("pressure_harmonics"), sampling = ledger.of("time_sampling");
  const double largest = std::max({discretisation, harmonics, sampling});
  bool possible = false;
  if (sampling > mended_along * largest) {
    scene.sampling.instants_per_turn *= 2;
    possible = true;
  }
  if (harmonics > mended_along * largest && body.pressure_harmonics < most_pressure_harmonics) {
    body.pressure_harmonics += 2;
    for (auto& [port, pressure] : body.pressures) pressure.highest_harmonic += 2;
    possible = true;
  }
  if (discretisation < largest) return {possible, false, 1};
  const auto* shaft = body.shaft();
  if (shaft != nullptr && shaft->keyways.empty()) return refine_shaft(body, analysis, known);
  if (std::holds_alternative<ChamberShape>(body.shape)) return refine_chamber(body, analysis);
  return refine_solid(body, analysis);
}

bool grows_without_bound(const std::vector<double>& values, const std::vector<double>& ratios) {
  const std::size_t n = values.size();
  if (n < 3 || ratios.size() + 1 < n) return false;
  const auto exponent = [&](std::size_t i) {  // from values[i] on
    return ratios[i] > 1 && values[i] > 0 ? std::log(values[i + 1] / values[i]) / std::log(ratios[i]) : 0.0;
  };
  return exponent(n - 2) > smallest_exponent && exponent(n - 2) >= kept_exponent * exponent(n - 3) &&
         exponent(n - 3) > 0;
}

void keep_discretisation(ErrorLedger& ledger, const ErrorLedger& before) {
  for (const auto& entry : before.numerical)
    if (entry.source == "discretisation") ledger.set_numerical(entry);
}

double learn_from_change(ErrorLedger& ledger, double change_Pa, double ratio, int n_meshes, double order,
                         double others_Pa) {
  if (!(ratio > 1)) return 0;
  const double told_Pa = std::abs(change_Pa) / (std::pow(ratio, order) - 1), missing_Pa = told_Pa + others_Pa;
  const double share = n_meshes <= 2 ? 1 : 0.5;
  const double own_Pa = share * ledger.of("discretisation") / discretisation_safety;
  if (missing_Pa > own_Pa)
    ledger.set_numerical({"discretisation",
                          fmt::format("change from the coarser mesh over (ratio of cell sizes)^{} - 1{}",
                                      order, others_Pa > 0 ? ", on the fillets and around" : ""),
                          missing_Pa});
  else
    ledger.set_numerical(
        {"discretisation",
         std::string(n_meshes <= 2 ? "" : "half of ") +
             "recovered stress against single cells around: the change from the coarser mesh is "
             "smaller",
         own_Pa});
  return told_Pa;
}

}  // namespace pipelines
