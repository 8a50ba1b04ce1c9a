#include "pipelines/study/accuracy/cost_forecast.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>

#include "fem/base/values/cost_constants.h"
#include "fem/solve/solvers/cost_prediction.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/judge/analysis/crest_elsewhere.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/reader/why_not.h"
#include "pipelines/scene/values/requested_accuracy.h"
#include "pipelines/search/cheap_models/described_body.h"
#include "pipelines/search/refinement/refinement.h"
#include "pipelines/search/refinement/second_model.h"

namespace pipelines {
namespace {

constexpr double even_factors[] = {0.5, 0.75, 1.5, 2, 3};
constexpr double beam_nodes = 1500;

/// Superposition on two threads: of one product of channel and unit stress; what the measures of stress take
/// at an instant, and a node's bookkeeping, in such products. AMD EPYC of 2023 with AVX-512, 2026-11-21, from
/// the times of `tests/benchmarks/run --benchmark_filter=superposition`.
constexpr double s_per_product = 1.5e-10, products_per_instant = 12, products_per_node = 7000;

/// Unknowns of the body's mesh, or about as many where none was made.
std::size_t unknowns_of(const BodyScene& body, const MeshedBody& meshed) {
  return meshed.model ? meshed.model->n_dofs() : estimated_unknowns(body);
}

bool is_of_tetrahedra(const BodyScene& body) {
  return std::holds_alternative<meshes::Import>(body.shape) ||
         (body.shaft() != nullptr && !body.shaft()->keyways.empty());
}

class Forecaster {
public:
  Forecaster(const BodyScene& body, const ForecastLoads& loads) : loads_(loads) {
    choice_.solver = body.solver;
  }

  /// @param meshed  the body's mesh, or without a model: by formula
  ModelForecast of(const std::string& model, const BodyScene& body, const MeshedBody& meshed) {
    n_dofs_ = unknowns_of(body, meshed);
    at_hand_ = meshed.model ? meshed.model->predict_solver(loads_.n_channels, choice_)
                            : fem::predict_solver(n_dofs_, body.degree, is_of_tetrahedra(body),
                                                  loads_.n_channels, choice_);
    return of(model, n_dofs_, *at_hand_);
  }
  /// Cells of the mesh looked at last become `factor` times smaller.
  ModelForecast finer(const std::string& model, const BodyScene& body, double factor) const {
    const auto n_dofs = std::size_t(double(n_dofs_) * factor * factor * factor);
    return of(model, n_dofs, fem::predict_solver(*at_hand_, n_dofs, body.degree, loads_.n_channels, choice_));
  }
  /// A model that superposes `n_nodes` nodes.
  ModelForecast cheap(const std::string& model, double n_dofs, double solve_s, double n_nodes) const {
    ModelForecast forecast{model,   std::size_t(n_dofs),  fem::Solver::automatic,
                           solve_s, superpose_s(n_nodes), 0};
    forecast.gigabytes = responses_gigabytes(n_nodes);
    return forecast;
  }

private:
  double superpose_s(double n_nodes) const {
    return s_per_product * n_nodes *
           (double(loads_.n_instants) * (double(loads_.n_channels) + products_per_instant) +
            products_per_node);
  }
  double responses_gigabytes(double n_nodes) const { return 72e-9 * n_nodes * double(loads_.n_channels); }

  ModelForecast of(const std::string& model, std::size_t n_dofs, const fem::SolverReport& report) const {
    const double n_nodes = double(n_dofs) / 3;
    return {model,
            n_dofs,
            report.used,
            report.predicted().seconds,
            superpose_s(n_nodes),
            1e-9 * report.predicted().bytes + responses_gigabytes(n_nodes)};
  }

  ForecastLoads loads_;
  fem::SolverChoice choice_;
  std::size_t n_dofs_ = 0;
  std::optional<fem::SolverReport> at_hand_;
};

}  // namespace

std::vector<ModelForecast> forecast_ladder(const BodyScene& body, const MeshedBody& meshed,
                                           const ForecastLoads& loads) {
  Forecaster forecaster(body, loads);
  std::vector<ModelForecast> models{forecaster.of("the scene's mesh", body, meshed)};
  const double n_dofs = double(models.front().n_dofs);
  if (why_not_beam(body).empty()) models.push_back(forecaster.cheap("beam", 3 * beam_nodes, 0, beam_nodes));
  if (why_not_axisymmetric(body).empty()) {
    // Meridian cells of degree 3 where the solid has 2; one problem for each harmonic.
    const double n_harmonics = 1 + std::max(1, body.pressure_harmonics);
    const double per_harmonic = 9.0 / 8 / body.shaft()->mesh.n_sectors * n_dofs;
    models.push_back(forecaster.cheap("axisymmetric", n_harmonics * per_harmonic,
                                      fem::cost::harmonic_s_per_dof * n_harmonics * per_harmonic,
                                      per_harmonic));
  }
  if (!can_be_refined(body)) return models;
  for (const double factor : even_factors)
    models.push_back(forecaster.finer(fmt::format("even mesh, cells 1/{:g}", factor), body, factor));
  const std::string first = "first of a search";
  const double tolerance = with_default({}).tolerance;
  std::string refused;
  if (!meshed.model) {
    models.push_back(forecaster.of(first, first_meshes(body).front(), meshed));
    return models;
  }
  for (const auto& candidate : first_meshes(body)) {  // as a search tries them
    refused = refusal_of([&] {
      auto coarse = mesh_body(candidate, loads.springs);
      const auto model = loads.of_body
                             ? axisymmetric_second_model(candidate, coarse, *loads.of_body, tolerance, 1)
                             : std::nullopt;
      if (model) coarse = mesh_body(guided_by(*model, candidate), loads.springs);
      models.push_back(forecaster.of(first, candidate, coarse));
    });
    if (refused.empty()) return models;
  }
  ModelForecast forecast;
  forecast.model = first;
  forecast.left_out = refused;
  models.push_back(forecast);
  return models;
}

void print_models(std::ostream& out, const std::vector<ModelForecast>& models) {
  out << fmt::format("  {:<24}{:>12}{:>10}{:>13}{:>10}  solver\n", "will take, about", "unknowns", "solve s",
                     "superpose s", "GB");
  for (const auto& model : models) {
    if (!model.left_out.empty()) {
      out << fmt::format("    {:<22}refused: {}\n", model.model, model.left_out);
      continue;
    }
    out << fmt::format("    {:<22}{:>12}{:>10.2g}{:>13.2g}{:>10.2g}  {}\n", model.model, model.n_dofs,
                       model.solve_s, model.superpose_s, model.gigabytes,
                       model.solver == fem::Solver::automatic   ? ""
                       : model.solver == fem::Solver::iterative ? "conjugate gradients"
                                                                : "factorisation");
  }
}

std::string forecast_beside(const BodyScene& body, const MeshedBody& meshed) {
  std::string text;
  if (body.natural_frequencies > 0)
    text += fmt::format("  natural frequencies take about {:.2g} s more on the scene's mesh\n",
                        fem::cost::frequencies_s_per_dof * double(unknowns_of(body, meshed)));
  if (const auto n_toes = meshed.mesh.hot_spots.size(); n_toes > 0)
    text += fmt::format(
        "  with --tolerance none submodels take about {:.2g} s more for each weld toe that may lead, of {}\n",
        fem::cost::submodels_s_per_toe, n_toes);
  return text;
}

void print_forecast(std::ostream& out, const BodyScene& body, const MeshedBody& meshed,
                    const std::vector<ModelForecast>& models) {
  if (!meshed.model)
    out << "  by formula, since nothing was meshed: unknowns within a third, tetrahedra and seconds a factor "
           "of three\n";
  print_models(out, models);
  out << forecast_beside(body, meshed);
  out << "  (seconds of the machine that the prediction was made on)\n";
}

RunForecast forecast_run(const Scene& scene, const std::vector<std::vector<ModelForecast>>& ladders) {
  // Measured on the shipped scenes: solves of all steps, their meshes and estimates over the first mesh's
  // solve; the same of harmonics; a picture; what libraries and results take.
  constexpr double steps_of_search = 6, steps_of_harmonics = 3, picture_s = 2.5, other_s = 1;
  constexpr double growth_of_search = 2, other_gigabytes = 0.35;
  const auto accuracy = with_default(scene.accuracy);
  RunForecast run{other_s, other_gigabytes};
  double solves_s = 0, pictures_s = 0, largest_gigabytes = 0;
  for (const auto& ladder : ladders) {
    const auto find = [&](const std::string& model) -> const ModelForecast* {
      for (const auto& one : ladder)
        if (one.model == model && one.left_out.empty()) return &one;
      return nullptr;
    };
    const bool is_cheap = scene.method == Method::automatic || scene.method == Method::axisymmetric;
    const ModelForecast* model = nullptr;
    double steps = 1, growth = 1;
    if (scene.method == Method::beam)
      model = find("beam");
    else if (is_cheap && !accuracy.once && find("axisymmetric") != nullptr)
      model = find("axisymmetric"), steps = steps_of_harmonics;
    else if (accuracy.once)
      model = find("the scene's mesh");
    else
      model = find("first of a search"), steps = steps_of_search, growth = growth_of_search;
    if (model == nullptr) model = find("the scene's mesh");
    if (model == nullptr) continue;
    solves_s += steps * (model->solve_s + model->superpose_s);
    largest_gigabytes = std::max(largest_gigabytes, growth * model->gigabytes);
    if (scene.pictures) pictures_s += picture_s;
  }
  run.ends_by_limit = accuracy.time_limit_s > 0 && solves_s > accuracy.time_limit_s;
  if (run.ends_by_limit) solves_s = accuracy.time_limit_s;
  run.seconds += solves_s + pictures_s;
  run.gigabytes += largest_gigabytes;
  return run;
}

double expected_seconds(const Scene& scene) {
  constexpr std::size_t usual_channels = 32;
  const auto springs = springs_of(scene);
  const auto n_instants = std::size_t(scene.sampling.turns) * std::size_t(scene.sampling.instants_per_turn);
  std::vector<std::vector<ModelForecast>> ladders;
  for (const auto& body : scene.bodies) {
    if (!can_be_refined(body) || !has_known_ports(body)) return 0;
    ladders.push_back(
        forecast_ladder(body, describe_body(body, springs), {usual_channels, n_instants, springs}));
  }
  return forecast_run(scene, ladders).seconds;
}

}  // namespace pipelines
