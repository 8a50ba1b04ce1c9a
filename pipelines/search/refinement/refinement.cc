#include "pipelines/search/refinement/refinement.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/search/refinement/local_refinement.h"
#include "pipelines/search/refinement/solid_refinement.h"
#include "pipelines/superpose/between_instants/factor_spectrum.h"

namespace pipelines {
namespace {

constexpr std::array<int, 9> cells_on_quarters = {2, 6, 8, 12, 16, 24, 32, 48, 64};
constexpr double coarser_start = 1 / 1.5, step_factor = 1.5;
constexpr int coarsest_start = 4;  // times coarser_start: where time is short
/// Cells on a fillet quarter and sectors of a shaft's first mesh; the later ones where the mesher refuses
/// one.
constexpr std::array<std::array<int, 2>, 4> first_shaft_meshes = {{{2, 8}, {4, 8}, {4, 12}, {6, 16}}};
/// With fewer cells on its quarter a fillet's stress does not converge with its order yet.
constexpr int resolved_fillet = 4;
/// Shares of the largest stress: fillets above the first are resolved from the start, above the second half
/// as well.
constexpr double leading_share = 0.8, minor_share = 0.5;
constexpr double toe_step = 2, other_toes_step = 1.1, elsewhere_step = 1.05, toe_order = 1;
/// Entries that large beside the largest one are mended in the same step.
constexpr double mended_along = 1.0 / 3;
constexpr int most_pressure_harmonics = 64;
constexpr double smallest_exponent = 0.1, kept_exponent = 0.75;

constexpr int most_steps = 16;
/// Below this share of the error that no mesh lowers finer meshes would hardly lower the sum.
constexpr double well_known_beside = 0.3;
/// Steps that may pass without a lower error: each part of a mesh once, and one.
constexpr std::size_t patience = 5;

int next_cells(int cells) {
  const auto next = std::upper_bound(cells_on_quarters.begin(), cells_on_quarters.end(), cells);
  return next == cells_on_quarters.end() ? cells : *next;
}

/// Index among the shaft's fillets of each one that may hold the largest stress, by its own stress and error.
std::vector<std::size_t> fillets_that_may_lead(const BodyScene& body,
                                               const std::vector<PlaceStress>& judged) {
  const auto names = fillets_of(body);
  const double leading_Pa = judged[judge(judged).governing].value_Pa;
  std::vector<std::size_t> result;
  for (std::size_t f = 0; f < names.size(); ++f)
    for (const auto& place : judged)
      if (!names[f].empty() && place.feature == names[f] && place.value_Pa + place.error_Pa >= leading_Pa)
        result.push_back(f);
  return result;
}

/// Whether cells are half or twice as large away from the toes moves the hot-spot stress of a tube by 1 %, at
/// the toes by 4 %, through the wall, beside them, by 3 %.
MeshStep refine_chamber(BodyScene& body, const Judged& analysis, const std::vector<PlaceStress>& judged) {
  const auto& target = judged[judge(judged).holding_back].feature;
  const bool is_toe = std::any_of(analysis.hot_spots.begin(), analysis.hot_spots.end(),
                                  [&](const auto& spot) { return spot.name == target; });
  if (!is_toe) {  // a surface: it may be anywhere
    body = with_fineness(body, step_factor);
    return {MeshPart::all, step_factor, toe_order, {}};
  }
  const auto before = std::get<ChamberShape>(body.shape).mesh;
  body = with_fineness(body, elsewhere_step);
  auto& mesh = std::get<ChamberShape>(body.shape).mesh;
  mesh.cells_through_wall =
      std::min(before.cells_through_wall + 1, meshes::ChamberMeshControl::most_cells_through_wall);
  mesh.toe_walls = before.toe_walls / other_toes_step;
  mesh.fine_toes = before.fine_toes;
  MeshStep step{MeshPart::all, toe_step, toe_order, {}};
  for (const auto& spot : analysis.hot_spots) {
    const auto place =
        std::find_if(judged.begin(), judged.end(), [&](const auto& p) { return p.feature == spot.name; });
    if (place == judged.end() || place->value_Pa + place->error_Pa < analysis.hot_spots.front().von_mises_Pa)
      continue;
    step.features.push_back(spot.name);
    const auto same = [&](const meshes::FineToe& toe) { return toe.at_m == spot.toe_m; };
    const auto fine = std::find_if(mesh.fine_toes.begin(), mesh.fine_toes.end(), same);
    if (fine != mesh.fine_toes.end())
      fine->walls /= toe_step;
    else
      mesh.fine_toes.push_back({spot.toe_m, before.toe_walls / toe_step});
  }
  return step;
}

/// The two fillets nearest to a place along the axis: rows of cells at a fillet run through to what is beside
/// it.
std::vector<std::size_t> fillets_beside(const BodyScene& body, const PlaceStress& place) {
  const auto names = fillets_of(body);
  const auto& segments = body.shaft()->geometry.segments;
  std::vector<std::size_t> fillets;
  for (std::size_t f = 0; f < names.size(); ++f)
    if (!names[f].empty()) fillets.push_back(f);
  const auto distance_m = [&](std::size_t f) { return std::abs(segments[f].end_m - place.position_m[2]); };
  std::stable_sort(fillets.begin(), fillets.end(),
                   [&](std::size_t a, std::size_t b) { return distance_m(a) < distance_m(b); });
  fillets.resize(std::min<std::size_t>(2, fillets.size()));
  return fillets;
}

std::optional<MeshStep> refine_fillets(BodyScene& body, const std::vector<PlaceStress>& judged) {
  auto& mesh = std::get<ShaftShape>(body.shape).mesh;
  const auto names = fillets_of(body);
  mesh.fillet_cells.resize(names.size(), 0);
  MeshStep step{MeshPart::fillets, 1, 2, {}};
  const auto& target = judged[judge(judged).holding_back];
  const bool is_fillet = std::find(names.begin(), names.end(), target.feature) != names.end();
  for (const auto f : is_fillet ? fillets_that_may_lead(body, judged) : fillets_beside(body, target)) {
    const int before = mesh.cells_at(int(f)), after = next_cells(before);
    if (after == before) continue;
    mesh.fillet_cells[f] = after;
    step.features.push_back(names[f]);
    step.ratio = std::max(step.ratio, double(after) / before);
    if (before < resolved_fillet) step.order = 1;
  }
  if (step.features.empty()) return std::nullopt;
  const auto got_finer = [&](std::size_t f) {
    return std::find(step.features.begin(), step.features.end(), names[f]) != step.features.end();
  };
  auto features = step.features;
  for (const auto& place : judged) {  // what they do to the places beside them is learnt from as well
    if (std::find(names.begin(), names.end(), place.feature) != names.end()) continue;
    const auto beside = fillets_beside(body, place);
    if (std::all_of(beside.begin(), beside.end(), got_finer)) features.push_back(place.feature);
  }
  if (!is_fillet && !contains(features, target.feature)) features.push_back(target.feature);
  step.features = std::move(features);
  return step;
}

std::optional<MeshStep> refine_shaft(BodyScene& body, const std::vector<PlaceStress>& judged, MeshPart part) {
  auto& mesh = std::get<ShaftShape>(body.shape).mesh;
  if (part == MeshPart::fillets) return refine_fillets(body, judged);
  if (part == MeshPart::around) {
    const int before = mesh.n_sectors;
    mesh.n_sectors = with_fineness(body, step_factor).shaft()->mesh.n_sectors;
    // Cells are as long as they are wide by default: around alone means that they keep their length.
    mesh.axial_share *= double(mesh.n_sectors) / before;
    return MeshStep{part, double(mesh.n_sectors) / before, 2, {}};
  }
  if (part == MeshPart::through) {
    mesh.rows_factor *= step_factor;
    return MeshStep{part, step_factor, 2, {}};
  }
  mesh.growth /= step_factor;
  mesh.axial_share /= step_factor;
  mesh.largest_cell_m /= step_factor;
  return MeshStep{part, step_factor, 2, {}};
}

std::optional<MeshStep> refine_solid(BodyScene& body, const Superposed& analysis,
                                     const std::vector<PlaceStress>& judged) {
  if (!can_be_refined(body)) return std::nullopt;  // its cells may be hexahedra
  auto* shaft = std::get_if<ShaftShape>(&body.shape);
  auto& control = shaft ? shaft->solid : std::get<meshes::Import>(body.shape).control;
  const auto leading = leading_surface(analysis, judged);
  if (leading.spots.empty()) return std::nullopt;
  for (const auto& spot : leading.spots) {
    control.fine_spots.push_back(spot);
    control.smallest_size_m = std::min(control.smallest_size_m, spot.size_m);
  }
  return MeshStep{MeshPart::all, leading.ratio, 2, leading.features};
}

}  // namespace

bool is_block_shaft(const BodyScene& body) {
  return body.shaft() != nullptr && body.shaft()->keyways.empty();
}

namespace {

bool is_bored(const BodyScene& body) {
  const auto& segments = body.shaft()->geometry.segments;
  return std::any_of(segments.begin(), segments.end(),
                     [](const auto& segment) { return segment.bore_m > 0; });
}

}  // namespace

std::vector<MeshPart> mesh_parts(const BodyScene& body) {
  if (is_refined_locally(body)) return {MeshPart::local};
  if (!is_block_shaft(body)) return {MeshPart::all};
  const auto fillets = fillets_of(body);
  const bool has_fillets =
      std::any_of(fillets.begin(), fillets.end(), [](const auto& name) { return !name.empty(); });
  std::vector<MeshPart> parts{MeshPart::around, MeshPart::along};
  if (has_fillets) parts.insert(parts.begin(), MeshPart::fillets);
  if (is_bored(body)) parts.push_back(MeshPart::through);
  return parts;
}

TrustInMeshes trust_in_meshes(const BodyScene& body) {
  constexpr double after_one = 1 / discretisation_safety, after_more = 0.5 / discretisation_safety;
  if (is_block_shaft(body))
    return is_refined_locally(body) ? TrustInMeshes{after_one, after_more, 0.12} : TrustInMeshes{};
  if (std::holds_alternative<ChamberShape>(body.shape)) return {after_one, after_more};
  return {1, 1};
}

std::vector<BodyScene> first_meshes(const BodyScene& body) {
  std::vector<BodyScene> meshes;
  if (!is_block_shaft(body)) {
    meshes = {with_fineness(body, coarser_start)};
    if (std::holds_alternative<ChamberShape>(body.shape) && is_refined_locally(body)) {
      meshes.insert(meshes.begin(), meshes.front());
      auto& mesh = std::get<ChamberShape>(meshes.front().shape).mesh;
      mesh.lean = true;
      mesh.toe_walls = meshes::ChamberMeshControl::lean_toe_walls;
    }
  } else {
    // Eight cells around hold a shell round, whose ovals then are missing among the lowest modes.
    const int for_ovals = body.natural_frequencies > 0 && is_bored(body) ? body.shaft()->mesh.n_sectors : 0;
    const auto add = [&](const std::array<int, 2>& cells_and_sectors, bool lean) {
      meshes.push_back(body);
      auto& mesh = std::get<ShaftShape>(meshes.back().shape).mesh;
      mesh.cells_per_fillet_quarter = cells_and_sectors[0];
      mesh.fillet_cells.clear();
      mesh.n_sectors = std::max(cells_and_sectors[1], for_ovals);
      mesh.lean = lean;
    };
    if (is_refined_locally(body)) add(first_shaft_meshes.front(), true);
    for (const auto& cells_and_sectors : first_shaft_meshes) add(cells_and_sectors, false);
  }
  meshes.push_back(body);
  return meshes;
}

std::vector<BodyScene> first_meshes_in_time(const BodyScene& body) {
  if (!std::holds_alternative<meshes::Import>(body.shape) || !can_be_refined(body)) return {};
  std::vector<BodyScene> meshes;
  for (int step = 1; step <= coarsest_start; ++step)
    meshes.push_back(with_fineness(body, std::pow(coarser_start, step)));
  return meshes;
}

std::vector<BodyScene> nearly_as_fine(const BodyScene& body) {
  constexpr std::array<double, 3> factors = {1.04, 1.09, 1.15};
  std::vector<BodyScene> meshes;
  const bool is_of_tetrahedra = !is_refined_locally(body) && !is_block_shaft(body) &&
                                !std::holds_alternative<ChamberShape>(body.shape) && can_be_refined(body);
  for (const double factor : factors) {
    if (!is_of_tetrahedra) break;
    meshes.push_back(body);
    auto* shaft = std::get_if<ShaftShape>(&meshes.back().shape);
    auto& control = shaft ? shaft->solid : std::get<meshes::Import>(meshes.back().shape).control;
    control.size_factor /= factor;
    control.smallest_size_m /= factor;
    control.cells_per_circle = int(std::ceil(factor * control.cells_per_circle));
    for (auto& spot : control.fine_spots) spot.size_m /= factor;
  }
  return meshes;
}

BodyScene guided_by(const SecondModel& model, const BodyScene& body) {
  BodyScene result = body;
  if (!is_block_shaft(body) || model.places.empty()) return result;
  auto& mesh = std::get<ShaftShape>(result.shape).mesh;
  const auto names = fillets_of(body);
  const double largest_Pa = model.places[judge(model.places).governing].value_Pa;
  mesh.fillet_cells.resize(names.size(), 0);
  const int leading_cells = mesh.lean ? 8 : 6;
  for (std::size_t f = 0; f < names.size(); ++f)
    for (const auto& place : model.places) {
      if (names[f].empty() || place.feature != names[f]) continue;
      const double share = (place.value_Pa + place.error_Pa) * (1 + model.model_error) / largest_Pa;
      const int wanted = share > leading_share ? leading_cells : share > minor_share ? 4 : 2;
      mesh.fillet_cells[f] = std::max(wanted, mesh.cells_at(int(f)));
    }
  return result;
}

namespace {

/// Factors on the number of instants; a multiple of twelve has short transforms.
constexpr double least_more_instants = 1.5, most_more_instants = 8;
constexpr double instants_of_a_kind = 12;

/// What a crest is missed by falls with the square of the number of instants; the spectra may tell of less.
/// @param share     of the largest stress that crests may be missed by, > 0
/// @param sampling  share that they are missed by now
int more_instants_per_turn(int before, const ChannelHistory& loads, double share, double sampling) {
  double more = std::sqrt(sampling / share);
  const bool are_told = !passes_over_much(loads);  // else the instants' spectrum lacks what they miss
  if (are_told && can_be_transformed(loads.values.cols()))
    more = std::min(more, instants_needed(loads, share).n_instants / double(loads.values.cols()));
  more = std::clamp(more, least_more_instants, most_more_instants);
  return int(instants_of_a_kind * std::ceil(more * before / instants_of_a_kind));
}

/// Half as many again, at least two, since the series of a narrow pattern ends late; an even number, as a
/// scene has.
int more_harmonics(const BodyScene& body) {
  int highest = body.pressure_harmonics;
  for (const auto& [port, pressure] : body.pressures) highest = std::max(highest, pressure.highest_harmonic);
  return std::max(2, std::min(highest / 4 * 2, (most_pressure_harmonics - highest) / 2 * 2));
}

}  // namespace

OtherRefinement refine_sampling_and_harmonics(Scene& scene, std::size_t index, const GoverningStress& stress,
                                              const ChannelHistory& loads) {
  const auto& errors = stress.errors;
  BodyScene& body = scene.bodies[index];
  const double mesh = errors.of("discretisation") + errors.of("geometry") + errors.of("other_places");
  const double harmonics = errors.of("pressure_harmonics"), sampling = errors.of("time_sampling");
  const double largest = std::max({mesh, harmonics, sampling});
  OtherRefinement result;
  if (sampling > mended_along * largest) {
    constexpr double least_share = 1e-4;
    const double others_share = std::max(mesh, harmonics) / stress.value_Pa;
    scene.sampling.instants_per_turn = more_instants_per_turn(
        scene.sampling.instants_per_turn, loads, std::max(least_share, mended_along * others_share),
        sampling / stress.value_Pa);
    result.possible = true;
  }
  if (harmonics > mended_along * largest && body.pressure_harmonics < most_pressure_harmonics) {
    const int more = more_harmonics(body);
    body.pressure_harmonics += more;
    for (auto& [port, pressure] : body.pressures) pressure.highest_harmonic += more;
    result.possible = true;
  }
  result.mesh_matters = mesh >= largest;
  return result;
}

std::optional<MeshStep> refine_mesh(BodyScene& body, const Judged& analysis,
                                    const std::vector<PlaceStress>& judged, MeshPart part) {
  if (judged.empty()) return std::nullopt;
  if (is_block_shaft(body)) return refine_shaft(body, judged, part);
  if (std::holds_alternative<ChamberShape>(body.shape)) return refine_chamber(body, analysis, judged);
  return refine_solid(body, analysis, judged);
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

bool stands_still(const Search& search) {
  const auto& steps = search.steps;
  if (steps.size() <= patience) return false;
  const auto error = [](const SearchStep& step) { return step.errors.numerical_Pa() / step.value_Pa; };
  const double before = error(steps[steps.size() - 1 - patience]);
  return std::all_of(steps.end() - patience, steps.end(),
                     [&](const auto& step) { return error(step) > 0.9 * before; });
}

std::string reason_to_end(const Search& search, const GoverningStress& stress, bool of_blocks) {
  if (search.tolerance > 0 && search.met) return "the tolerance is met";
  if (stress.value_Pa == 0) return "nothing is stressed";
  if (search.tolerance > 0 && stress.errors.of("cancellation") > search.tolerance * stress.value_Pa)
    return "what is left of loads that cancel has no more digits";
  if (const double locking_Pa = stress.errors.of("locking");
      search.tolerance > 0 && locking_Pa > search.tolerance * stress.value_Pa &&
      stress.errors.numerical_Pa() <= well_known_beside * locking_Pa)
    return "what cells lose by a Poisson's ratio near 0.5 is more than was asked, and no mesh lowers it: a "
           "ratio of 0.49 and less is computed better";
  if (int(search.steps.size()) >= most_steps) return "too many steps";
  if (of_blocks && stands_still(search)) return "finer meshes no longer lower the error";
  return {};
}

void learn_from_change(ErrorBudget& budget, double change_Pa, double ratio, int n_meshes, double order) {
  if (!(ratio > 1)) return;
  const double missing_Pa = std::abs(change_Pa) / (std::pow(ratio, order) - 1);
  const double share = n_meshes <= 2 ? 1 : 0.5;
  const double own_Pa = share * budget.of("discretisation") / budget.safety_of("discretisation");
  if (missing_Pa > own_Pa)
    budget.set_numerical(
        {"discretisation",
         fmt::format("change from the coarser mesh over (ratio of cell sizes)^{} - 1", order), missing_Pa});
  else
    budget.set_numerical(
        {"discretisation",
         std::string(n_meshes <= 2 ? "" : "half of ") +
             "recovered stress against single cells around: the change from the coarser mesh is "
             "smaller",
         own_Pa});
}

}  // namespace pipelines
