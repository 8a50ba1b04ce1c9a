#include "pipelines/judge/estimates/error_budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "fem/stress/cells/cell_stress_at_node.h"
#include "pipelines/judge/estimates/fitted.h"
#include "pipelines/judge/estimates/solved_pressure.h"
#include "pipelines/judge/estimates/submodels.h"
#include "pipelines/judge/estimates/tetrahedra_estimate.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {
namespace {

/// What a finer model than harmonics or a beam would not leave out.
constexpr std::array<const char*, 7> of_cheaper_models = {
    "model", "beam_model", "near_loads", "eccentric_segments", "offset_axis", "ovalisation", "spin"};

double sum_of(const std::vector<ErrorEntry>& entries) {
  double sum = 0;
  for (const auto& entry : entries) sum += entry.value_Pa;
  return sum;
}

void set(std::vector<ErrorEntry>& entries, const ErrorEntry& entry) {
  const auto same = std::find_if(entries.begin(), entries.end(),
                                 [&](const auto& other) { return other.source == entry.source; });
  if (same == entries.end())
    entries.push_back(entry);
  else
    *same = entry;
}

/// What the harmonics that the seats' pressures go on with above those of the scene would bring.
double pressure_tail_Pa(const BodyLoads& loads, const std::vector<std::array<double, 6>>& unit) {
  double sum_Pa = 0;
  for (const auto& [port, pressure] : solved_pressures(loads))
    sum_Pa +=
        harmonics_from_Pa({pressure, unit}, pressure.model.pattern, pressure.model.highest_harmonic + 1);
  return sum_Pa;
}

/// Nodes of the boundary faces that hold the node; of its own alone if none does.
std::set<std::size_t> on_faces_around(const fem::Nodes& nodes, std::size_t node) {
  std::set<std::size_t> around{node};
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    if (std::find(face.begin(), face.end(), std::int32_t(node)) != face.end())
      around.insert(face.begin(), face.end());
  }
  return around;
}

double cell_difference(const fem::UnitResponses& responses, const fem::Material& material, std::size_t node,
                       const Eigen::ArrayXd& factors) {
  const double recovered = von_mises_of(unit_stress_at(responses, {{{node, 1.0}}, 0}), factors);
  double largest = 0;
  for (const auto& of_cell : fem::cell_stress_at_node_Pa(responses, material, node))
    largest = std::max(largest, std::abs(von_mises_of(of_cell, factors) - recovered));
  return largest;
}

double discretisation_error(const StressPoint& point, const fem::UnitResponses& responses,
                            const fem::Material& material, const Eigen::ArrayXd& factors,
                            const std::vector<char>& left_out) {
  if (point.parts.size() > 1) {  // extrapolated: each node for itself
    double sum = 0;
    for (const auto& part : point.parts)
      sum += std::abs(part.weight) * cell_difference(responses, material, part.node, factors);
    return sum;
  }
  double largest = 0;
  const auto own = point.parts.front().node;
  for (const auto node : on_faces_around(responses.nodes, own))
    if (node == own || left_out.empty() || !left_out[node])
      largest = std::max(largest, cell_difference(responses, material, node, factors));
  return largest;
}

}  // namespace

double ErrorBudget::numerical_Pa() const {
  return sum_of(numerical);
}

double ErrorBudget::total_Pa() const {
  return numerical_Pa() + sum_of(model);
}

double ErrorBudget::reducible_Pa() const {
  double sum_Pa = numerical_Pa();
  for (const char* source : of_cheaper_models) sum_Pa += of(source);
  return sum_Pa;
}

std::string ErrorBudget::largest_reducible() const {
  std::string result = largest();
  for (const char* source : of_cheaper_models)
    if (of(source) > (result.empty() ? 0 : of(result))) result = source;
  return result;
}

std::string ErrorBudget::largest() const {
  const auto entry = std::max_element(numerical.begin(), numerical.end(),
                                      [](const auto& a, const auto& b) { return a.value_Pa < b.value_Pa; });
  return entry == numerical.end() ? "" : entry->source;
}

double ErrorBudget::of(const std::string& source) const {
  for (const auto* entries : {&numerical, &model})
    for (const auto& entry : *entries)
      if (entry.source == source) return entry.value_Pa;
  return 0;
}

double ErrorBudget::safety_of(const std::string& source) const {
  for (const auto& entry : numerical)
    if (entry.source == source) return entry.safety;
  return 1;
}

void ErrorBudget::set_numerical(const ErrorEntry& entry) {
  set(numerical, entry);
}

void ErrorBudget::set_model(const ErrorEntry& entry) {
  set(model, entry);
}

std::vector<std::array<double, 6>> unit_stress_at(const fem::UnitResponses& responses,
                                                  const StressPoint& point) {
  if (point.resolved) return point.resolved->unit_Pa;
  const std::size_t n_channels = responses.channels.size();
  std::vector<std::array<double, 6>> unit(n_channels, std::array<double, 6>{});
  for (const auto& part : point.parts) {
    const double* of_node = responses.stress_anywhere_Pa(part.node);
    for (std::size_t k = 0; k < n_channels; ++k)
      for (std::size_t c = 0; c < 6; ++c) unit[k][c] += part.weight * of_node[6 * k + c];
  }
  return unit;
}

double von_mises_of(const std::vector<std::array<double, 6>>& unit, const Eigen::ArrayXd& factors) {
  Stress stress{};
  for (std::size_t k = 0; k < unit.size(); ++k)
    for (std::size_t c = 0; c < 6; ++c) stress[c] += factors[Eigen::Index(k)] * unit[k][c];
  return von_mises_Pa(stress);
}

namespace {

constexpr const char* loads_between_instants = "loads between the instants, which these do not tell";

/// What is left of channels and effects that cancel has the errors of all of them: the solver's and
/// rounding's share of each channel's own stress, and rounding's of each effect's. Zero where one channel of
/// one effect stands alone.
double cancellation_error_Pa(const std::vector<std::array<double, 6>>& unit, const ChannelHistory& loads,
                             Eigen::Index instant, double value_Pa, double solver_share) {
  if (value_Pa == 0) return 0;  // nothing is stressed
  double of_channels_Pa = 0, of_effects_Pa = 0;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const double unit_Pa = von_mises_Pa(unit[k]);
    double effects = 0;
    for (const auto& effect : loads.by_effect) effects += std::abs(effect(Eigen::Index(k), instant));
    const double sum = std::abs(loads.values(Eigen::Index(k), instant));
    of_channels_Pa += sum * unit_Pa;
    of_effects_Pa += std::max(effects, sum) * unit_Pa;
  }
  return solver_share * std::max(0.0, of_channels_Pa - value_Pa) +
         std::numeric_limits<double>::epsilon() * std::max(0.0, of_effects_Pa - value_Pa);
}

/// How much too low a stress may come out because cells of degree 1 and 2 cannot keep the volume of an almost
/// incompressible material; the recovered stress does not see it. By fitted.h.
double locking_share(const fem::UnitResponses& responses, const fem::Material& material) {
  const bool is_of_cells = !responses.energy_error.norm_sqrtJ.empty();
  if (!is_of_cells || responses.nodes.degree > 2 || material.poisson_ratio <= fitted::locking_from) return 0;
  return fitted::locking_most / (1 + (1 - 2 * material.poisson_ratio) / fitted::locking_half_way);
}

}  // namespace

std::optional<ErrorEntry> discretisation_estimate(const StressPoint& point,
                                                  const fem::UnitResponses& responses,
                                                  const ChannelHistory& history,
                                                  const fem::Material& material,
                                                  const std::vector<char>& left_out) {
  const Eigen::ArrayXd factors = history.values.col(point.instant);
  if (point.resolved)
    return ErrorEntry{"discretisation", submodel_method,
                      point.resolved->error_share * von_mises_of(point.resolved->unit_Pa, factors), 1};
  if (responses.nodes.n_cells() == 0) return std::nullopt;
  if (responses.nodes.shape().is_tetrahedron())
    return tetrahedra_estimate(point, responses, material, {factors.begin(), factors.end()});
  if (responses.energy_error.norm_sqrtJ.empty()) return std::nullopt;
  return ErrorEntry{
      "discretisation", "recovered stress against single cells around, times a safety factor of 3",
      discretisation_safety * discretisation_error(point, responses, material, factors, left_out)};
}

ErrorBudget self_estimate(const StressPoint& point, const fem::UnitResponses& responses,
                          const BodyLoads& loads, const fem::Material& material, double geometry_share,
                          const std::vector<char>& left_out) {
  const auto& values = loads.history.values;
  const Eigen::ArrayXd factors = values.col(point.instant);
  const auto unit = unit_stress_at(responses, point);
  const double value = von_mises_of(unit, factors);

  ErrorBudget budget;
  const auto sampling = time_sampling(unit, values);
  const double error_Pa = sampling_error_Pa(unit, loads.history);
  if (error_Pa != sampling.error_Pa())
    budget.numerical.push_back({"time_sampling", loads_between_instants, error_Pa});
  else
    budget.numerical.push_back({"time_sampling",
                                sampling.unresolved_Pa == 0
                                    ? "crest between the instants, which resolve the channels"
                                    : "crest between the instants, and what they leave unresolved",
                                sampling.error_Pa()});
  budget.numerical.push_back(
      {"pressure_harmonics",
       "the patterns' harmonics that were left out, by the stress of those that were not",
       pressure_tail_Pa(loads, unit)});
  if (auto entry = discretisation_estimate(point, responses, loads.history, material, left_out))
    budget.numerical.push_back(std::move(*entry));
  if (const double share = locking_share(responses, material); share > 0)
    budget.model.push_back(
        {"locking", "displacement cells of an almost incompressible material, fitted", share * value});
  budget.numerical.push_back(
      {"geometry", "distance of curved faces around from their surfaces", geometry_share * value});
  const double solver_share = std::max(responses.residual, responses.solver.rounding);
  budget.numerical.push_back({"linear_solver", "relative residual, or rounding", solver_share * value});
  budget.numerical.push_back(
      {"cancellation", "the solver's and rounding's share of all that cancels",
       cancellation_error_Pa(unit, loads.history, point.instant, value, solver_share)});
  return budget;
}

double geometry_share(const fem::GeometryError& error, const fem::Nodes& nodes, const StressPoint& point) {
  double largest = 0;
  bool is_curved = false;
  for (const auto& part : point.parts)
    for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
      const auto face = nodes.face(f);
      const auto surface = error.surfaces.find(nodes.face_boundary_id[f]);
      if (surface == error.surfaces.end() ||
          std::find(face.begin(), face.end(), std::int32_t(part.node)) == face.end())
        continue;
      is_curved = true;
      largest = std::max(largest, 3 * surface->second.of_axis + surface->second.of_fillet / 2);
    }
  return is_curved ? largest : 3 * error.relative;
}

double straight_edge_share(const std::vector<meshes::StraightEdge>& edges, const fem::Nodes& nodes,
                           const StressPoint& point) {
  double largest = 0;
  for (const auto& edge : edges)
    for (const auto& part : point.parts) {
      const double* x = &nodes.xyz_m[3 * std::size_t(part.node)];
      if (std::hypot(x[0] - edge.middle_m[0], x[1] - edge.middle_m[1], x[2] - edge.middle_m[2]) <
          edge.length_m)
        largest = std::max(largest, 4 * edge.off_m / edge.length_m);
    }
  return largest;
}

}  // namespace pipelines
