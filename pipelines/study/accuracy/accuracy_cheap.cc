#include <algorithm>
#include <cmath>
#include <optional>

#include "fem/models/beam/beam_responses.h"
#include "fem/models/beam/plated_tube.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/scene/reader/why_not.h"
#include "pipelines/search/cheap_models/chamber_tube.h"
#include "pipelines/search/cheap_models/cheap_responses.h"
#include "pipelines/study/accuracy/accuracy_models.h"

namespace pipelines {
namespace {

/// Cells become half as large from one size of harmonics to the next. Ends of loaded zones let stress
/// converge with first order only: of a change d, d is missing still.
constexpr double size_ratio = 2, harmonics_order = 1;

/// A cheap model's responses, and what the model itself is known to be off by.
struct CheapModel {
  fem::UnitResponses responses;
  double model_error = 0;  ///< relative
  std::string method, fineness;
  std::optional<fem::BeamShaft> beam{};  ///< then its entries stand in place of model_error
};

using Loads = std::vector<fem::UnitLoad>;

std::optional<CheapModel> beam_model(const BodyScene& body, const meshes::BodyMesh& mesh,
                                     const Loads& loads) {
  auto responses = beam_responses(body, mesh, loads);
  if (!responses) return std::nullopt;
  return CheapModel{std::move(*responses), 0, "", "published fillet factors", beam_shaft(body, mesh)};
}

std::optional<CheapModel> axisymmetric_model(const BodyScene& body, const meshes::BodyMesh& mesh,
                                             const Loads& loads) {
  auto model = axisymmetric_responses(body, mesh, loads);
  if (!model) return std::nullopt;
  return CheapModel{std::move(model->responses), model->model_error,
                    "axisymmetric: eccentric shoulders taken as concentric", fineness_text(body)};
}

AccuracyRow row_of(const std::string& name, const AccuracyBench& bench, const Loaded& loaded,
                   CheapModel model, StageClock& clock) {
  const auto& loads = loaded.body_loads[bench.index()];
  const auto& mesh = bench.own().mesh;
  const auto maximum = clock.run("superpose", [&] {
    return envelope(loads.history, model.responses, std::max(1, bench.options().n_threads));
  });
  const auto places = locate_nodes(model.responses.nodes, mesh.features, mesh.ports, mesh.sharp_edges);
  const auto node = peak_node(maximum.von_mises.value_Pa, places);
  AccuracyRow row;
  row.model = name;
  row.fineness = model.fineness;
  row.instants_per_turn = bench.scene().sampling.instants_per_turn;
  row.n_dofs = model.responses.n_dofs;
  row.value_Pa = maximum.von_mises.value_Pa[node];
  row.principal_Pa = maximum.principal.value_Pa[peak_node(maximum.principal.value_Pa, places)];
  row.errors = self_estimate({{{node, 1.0}}, maximum.von_mises.instant[node]}, model.responses, loads,
                             bench.body().material, 0);
  if (model.beam)
    row.errors.model = beam_model_entries(*model.beam, loads, model.responses.nodes,
                                          maximum.von_mises.value_Pa, places.excluded, row.value_Pa);
  else
    row.errors.model.push_back({"model", model.method, model.model_error * row.value_Pa});
  take_cost(row, clock);
  return row;
}

/// @param solve  gives the model, if the body has it
template <typename Solve>
std::optional<AccuracyRow> cheap_model(const std::string& name, AccuracyBench& bench, const BodyScene& body,
                                       const Loaded& loaded, Solve&& solve) {
  const auto& mesh = bench.own().mesh;
  std::optional<AccuracyRow> row;
  bench.is_done(name + ", " + fineness_text(body), [&] {
    row = bench.repeated(name, [&] {
      StageClock own;
      auto model =
          own.run("solve", [&] { return solve(body, mesh, loaded.body_loads[bench.index()].unit_loads); });
      return row_of(name, bench, loaded, std::move(model.value()), own);
    });
  });
  return row;
}

/// What the finest size misses: the last change, or half of the one before, since two sizes may agree by
/// chance. One size alone tells nothing.
double missing_of_finest_Pa(const std::vector<AccuracyRow>& rows) {
  if (rows.size() < 2) return rows.back().value_Pa;
  double missing_Pa = 0, share = 1 / (std::pow(size_ratio, harmonics_order) - 1);
  for (std::size_t i = rows.size() - 1; i > 0; --i, share /= std::pow(size_ratio, harmonics_order))
    missing_Pa = std::max(missing_Pa, share * std::abs(rows[i].value_Pa - rows[i - 1].value_Pa));
  return missing_Pa;
}

/// Takes for the error of each size its distance from the finest, and what that misses.
void learn_from_sizes(std::vector<AccuracyRow>& rows) {
  if (rows.empty()) return;
  const double finest_Pa = rows.back().value_Pa, missing_Pa = missing_of_finest_Pa(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto& row = rows[i];
    row.errors.set_numerical({"discretisation",
                              "distance from the finest section, and what the changes before say of that",
                              std::abs(row.value_Pa - finest_Pa) + missing_Pa});
    if (i > 0) row.seconds += rows[i - 1].seconds;
  }
}

/// What a run refuses has no row: its error would lack an entry.
bool is_refused(const char* name, Method method, AccuracyBench& bench) {
  const auto& body = bench.body();
  if (!beam_shaft(body, bench.own().mesh)) return true;
  const auto why = why_not(method, body);
  if (!why.empty()) bench.leave_out(name, "the " + body.name + ' ' + why);
  return !why.empty();
}

/// Weld toes have no other cheap model.
AccuracyRow shell_row(AccuracyBench& bench, const BodyLoads& loads) {
  return bench.repeated("shell", [&] {
    StageClock own;
    const auto responses = own.run(
        "solve", [&] { return plated_tube_responses(bench.body(), bench.own(), loads.unit_loads).value(); });
    AccuracyRow row;
    own.run("superpose", [&] {
      const auto worst = hot_spot_stresses(bench.own().mesh.hot_spots, responses, loads.history).front();
      const auto maximum = envelope(loads.history, responses, std::max(1, bench.options().n_threads));
      const auto& principal = maximum.principal.value_Pa;
      row.value_Pa = worst.von_mises_Pa;
      row.principal_Pa = *std::max_element(principal.begin(), principal.end());
      row.errors = self_estimate(stress_point(worst), responses, loads, bench.body().material, 0);
    });
    row.model = "shell";
    row.fineness = "rigid plates on a thin tube";
    row.instants_per_turn = bench.scene().sampling.instants_per_turn;
    row.n_dofs = responses.n_dofs;
    row.errors.model.push_back({"model",
                                "shell: rigid plates, diaphragms for flanges, loads through plates alone",
                                fem::plated_tube_error * row.value_Pa});
    take_cost(row, own);
    return row;
  });
}

}  // namespace

std::vector<AccuracyRow> cheap_models(AccuracyBench& bench) {
  std::vector<AccuracyRow> rows;
  const bool is_chamber = std::holds_alternative<ChamberShape>(bench.body().shape);
  if (!is_chamber && bench.has_hot_spots()) return rows;
  StageClock silent;
  const auto loaded = load_bodies(bench.scene(), bench.meshed(), silent);
  if (is_chamber) {
    if (bench.has_hot_spots()) rows.push_back(shell_row(bench, loaded.body_loads[bench.index()]));
    return rows;
  }
  if (!is_refused("beam", Method::beam, bench))
    if (auto row = cheap_model("beam", bench, bench.body(), loaded, beam_model))
      rows.push_back(std::move(*row));
  if (is_refused("axisymmetric", Method::axisymmetric, bench)) return rows;
  std::vector<AccuracyRow> sizes;
  for (const double factor : {0.5, 1.0, 2.0}) {
    auto row =
        cheap_model("axisymmetric", bench, with_fineness(bench.body(), factor), loaded, axisymmetric_model);
    // The same mesh again tells nothing.
    if (row && (sizes.empty() || row->n_dofs != sizes.back().n_dofs)) sizes.push_back(std::move(*row));
  }
  learn_from_sizes(sizes);
  rows.insert(rows.end(), sizes.begin(), sizes.end());
  return rows;
}

}  // namespace pipelines
