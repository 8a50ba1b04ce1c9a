#include "pipelines/write/living/living_body.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/scene/values/effect_groups.h"
#include "pipelines/superpose/kernels/deviatoric_coordinates.h"
#include "pipelines/write/living/field_modes.h"
#include "pipelines/write/living/page_places.h"
#include "pipelines/write/living/page_surface.h"
#include "pipelines/write/living/time_basis.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using summary::Json;

constexpr std::size_t most_nodes = 16000;  // 5 MB with the modes of a shipped scene
/// Shares of the largest stress, and of the largest displacement, that the modes may be off by.
constexpr double stress_tolerance = 2e-3, displacement_tolerance = 1e-2;
constexpr Index most_modes = 48, most_displacement_modes = 12;

std::string join(const std::string& body, const std::string& section) {
  return body + "/" + section;
}

/// The unit stress of surface nodes, zero where it is left out, and of places.
UnitFields stress_fields(const Judged& analysis, const PageSurface& surface,
                         const std::vector<PagePlace>& places) {
  const auto& responses = analysis.responses;
  const auto n_channels = Index(responses.channels.size());
  UnitFields fields;
  fields.n_components = 5;
  fields.values = Eigen::MatrixXd::Zero(Index(5 * (surface.nodes.size() + places.size())), n_channels);
  const auto enter = [&](std::size_t row, Index k, const double* stress) {
    double coordinates[5];
    find_deviatoric_coordinates(stress, coordinates);
    for (Index c = 0; c < 5; ++c) fields.values(Index(5 * row) + c, k) = coordinates[c];
  };
  for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
    const auto node = std::size_t(surface.nodes[i]);
    if (analysis.places.excluded[node]) continue;
    const double* stress = responses.stress_anywhere_Pa(node);
    for (Index k = 0; k < n_channels; ++k) enter(i, k, stress + 6 * k);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto unit_Pa = unit_stress_at(responses, places[i].point);
    for (Index k = 0; k < n_channels; ++k) enter(surface.nodes.size() + i, k, unit_Pa[std::size_t(k)].data());
  }
  return fields;
}

UnitFields displacement_fields(const Judged& analysis, const PageSurface& surface) {
  const auto& responses = analysis.responses;
  const auto n_channels = Index(responses.channels.size());
  UnitFields fields;
  fields.n_components = 3;
  fields.values.resize(Index(3 * surface.nodes.size()), n_channels);
  for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
    const double* moved = responses.displacement_anywhere_m(std::size_t(surface.nodes[i]));
    for (Index k = 0; k < n_channels; ++k)
      for (Index c = 0; c < 3; ++c) fields.values(Index(3 * i) + c, k) = moved[3 * k + c];
  }
  return fields;
}

template <typename Matrix>
std::vector<float> by_rows(const Matrix& matrix) {
  std::vector<float> values;
  values.reserve(std::size_t(matrix.size()));
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j) values.push_back(float(matrix(i, j)));
  return values;
}

void add_modes(const std::string& body, const char* name, const FieldModes& modes, Json& json,
               PackedBlock& block) {
  block.add(join(body, name), modes.values);
  block.add(join(body, name + std::string(" factors")), by_rows(modes.projection));
  json[name] = summary::object({{"rank", modes.rank},
                                {"steps", std::vector<double>(modes.steps.begin(), modes.steps.end())},
                                {"error", summary::number(modes.error)}});
}

void add_surface(const std::string& body, const Judged& analysis, const PageSurface& surface, Json& json,
                 PackedBlock& block) {
  json["nodes"] = surface.nodes.size();
  json["nodes_per_face"] = surface.nodes_per_face;
  json["faces"] = surface.n_faces();
  json["doubled_faces"] = surface.n_doubled;
  json["mirror_axis"] = surface.mirror_axis;
  json["mirror_at_m"] = summary::number(surface.mirror_at_m);
  std::vector<float> xyz_m;
  std::vector<double> envelope;
  std::vector<std::uint8_t> excluded;
  for (std::size_t d = 0; d < 3; ++d)
    for (const auto node : surface.nodes)
      xyz_m.push_back(float(analysis.responses.nodes.xyz_m[3 * std::size_t(node) + d]));
  block.add(join(body, "xyz"), xyz_m);
  for (const auto node : surface.nodes) {
    excluded.push_back(analysis.places.excluded[std::size_t(node)] ? 1 : 0);
    envelope.push_back(excluded.back() ? 0 : analysis.envelope.von_mises.value_Pa[std::size_t(node)]);
  }
  block.add(join(body, "excluded"), excluded);
  json["envelope_Pa"] = block.add_range(join(body, "envelope"), envelope);
  block.add(join(body, "faces"), surface.faces);
}

/// A field that the script does not put together anew, at the surface's nodes.
void add_field(const std::string& body, const char* name, const char* unit, const PageSurface& surface,
               const std::vector<double>& values, Json& json, PackedBlock& block) {
  std::vector<double> shown;
  for (const auto node : surface.nodes) shown.push_back(values[std::size_t(node)]);
  json["fields"].push_back(
      summary::object({{"name", name}, {"unit", unit}, {"range", block.add_range(join(body, name), shown)}}));
}

/// The group of effects that has the largest share of the largest stress, by its number from 0.
void add_leading_group(const std::string& body, const Judged& analysis, const PageSurface& surface,
                       Json& json, PackedBlock& block) {
  const auto& effects = analysis.loads.history.effects;
  const auto& shares = analysis.envelope.effect_share;
  const auto groups = effect_groups(effects);
  if (groups.size() < 2 || shares.empty()) return;
  std::vector<std::size_t> group_of(effects.size(), 0);
  auto names = Json::array();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    names.push_back(groups[g].name);
    for (std::size_t e = 0; e < effects.size(); ++e)
      if (contains(groups[g].effects, effects[e])) group_of[e] = g;
  }
  std::vector<std::uint8_t> leading;
  for (const auto node : surface.nodes) {
    std::vector<double> sums(groups.size(), 0.0);
    for (std::size_t e = 0; e < effects.size(); ++e)
      sums[group_of[e]] += double(shares[std::size_t(node) * effects.size() + e]);
    leading.push_back(std::uint8_t(std::max_element(sums.begin(), sums.end()) - sums.begin()));
  }
  block.add(join(body, "leading group"), leading);
  json["leading_groups"] = names;
}

void add_fields(const std::string& body, const Judged& analysis, const PageSurface& surface, Json& json,
                PackedBlock& block) {
  json["fields"] = Json::array();
  add_field(body, "largest principal stress", "Pa", surface, analysis.envelope.principal.value_Pa, json,
            block);
  if (analysis.fatigue) {
    std::vector<double> amplitude(analysis.responses.nodes.n, 0.0), utilisation = amplitude;
    const auto& cycles = analysis.fatigue->cycles;
    for (std::size_t i = 0; i < cycles.nodes.size(); ++i) {
      amplitude[cycles.nodes[i]] = cycles.cycles[i].amplitude_Pa;
      utilisation[cycles.nodes[i]] = analysis.fatigue->utilisation_at[i];
    }
    add_field(body, "stress amplitude", "Pa", surface, amplitude, json, block);
    add_field(body, "fatigue utilisation", "1", surface, utilisation, json, block);
  }
  add_leading_group(body, analysis, surface, json, block);
}

Json places_json(const std::vector<PagePlace>& places, std::size_t n_nodes, const ShownInstants& shown) {
  auto json = Json::array();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& place = places[i];
    const auto found = std::lower_bound(shown.instants.begin(), shown.instants.end(), place.instant);
    json.push_back(
        summary::object({{"kind", place.kind},
                         {"name", place.name},
                         {"note", place.note},
                         {"at_m", place.position_m},
                         {"value_Pa", summary::number(place.value_Pa)},
                         {"error_Pa", place.error_Pa < 0 ? Json(nullptr) : Json(place.error_Pa)},
                         {"instant", std::min(found, shown.instants.end() - 1) - shown.instants.begin()},
                         {"row", n_nodes + i}}));
  }
  return json;
}

Json laws_json(const FactorSignals& signals) {
  auto json = Json::array();
  for (const auto& law : signals.laws)
    json.push_back(Json::array(
        {law.channel, law.force, law.harmonic, law.is_sine ? 1 : 0, summary::number(law.factor)}));
  return json;
}

/// Forces at ports, where the unit loads' moments say that they act.
Json arrows_json(const Judged& analysis) {
  auto json = Json::array();
  const auto& channels = analysis.responses.channels;
  const auto& resultants = analysis.responses.resultants;
  for (std::size_t x = 0; x < channels.size() && x < resultants.size(); ++x) {
    const auto& name = channels[x];
    if (name.size() < 3 || name.compare(name.size() - 3, 3, ".fx") != 0) continue;
    const auto port = name.substr(0, name.size() - 3);
    const auto y = std::size_t(std::find(channels.begin(), channels.end(), port + ".fy") - channels.begin());
    if (y >= resultants.size() || resultants[x][0] == 0 || resultants[y][1] == 0) continue;
    const auto &fx = resultants[x], &fy = resultants[y];
    json.push_back(
        summary::object({{"port", port},
                         {"x", x},
                         {"y", y},
                         {"at_m", std::array<double, 3>{fy[5] / fy[1], -fx[5] / fx[0], fx[4] / fx[0]}}}));
  }
  return json;
}

/// Section planes: the resultants of unit loads, planes x K x 6.
void add_sections(const std::string& body, const Judged& analysis, Json& json, PackedBlock& block) {
  const auto& responses = analysis.responses;
  if (!analysis.diagrams || responses.sections.empty()) return;
  for (const auto& plane : responses.planes)
    json["sections"].push_back(summary::object({{"z_m", plane.z_m},
                                                {"radius_m", plane.radius_m},
                                                {"bore_m", plane.inner_radius_m},
                                                {"axis_m", Json::array({plane.axis_x_m, plane.axis_y_m})}}));
  std::vector<float> values;
  for (const auto& section : responses.sections)
    for (const double value : section.resultant) values.push_back(float(value));
  block.add(join(body, "sections"), values);
}

std::vector<std::int32_t> nodes_needed(const PageSurface& surface, const std::vector<PagePlace>& places) {
  auto nodes = surface.nodes;
  for (const auto& place : places)
    for (const auto& part : place.point.parts) nodes.push_back(std::int32_t(part.node));
  return nodes;
}

}  // namespace

ArrayXXd at(const ShownInstants& shown, const ArrayXXd& values) {
  if (shown.is_all) return values;
  ArrayXXd result(values.rows(), Index(shown.instants.size()));
  for (Index t = 0; t < result.cols(); ++t) result.col(t) = values.col(shown.instants[std::size_t(t)]);
  return result;
}

void bring_page_rows(const Judged& analysis) {
  if (!analysis.responses.shared) return;
  analysis.responses.bring(nodes_needed(
      page_surface(analysis.responses.nodes, analysis.responses.images, most_nodes), page_places(analysis)));
}

Json living_body(const Judged& analysis, std::size_t index, const FactorSignals& signals,
                 const std::vector<EffectToggle>& toggles, const ShownInstants& shown, PackedBlock& block) {
  const auto& body = analysis.scene.name;
  std::string none;
  const auto whole = at(shown, signals_of(signals, analysis.loads, analysis.loads, none));
  std::vector<ArrayXXd> changes{whole}, sets{signals.factors(whole)};
  for (const auto& toggle : toggles) {
    if (toggle.without.empty()) continue;
    const auto without = at(shown, toggle.without[index]);
    changes.push_back(whole - without);
    sets.push_back(signals.factors(without));
  }
  const auto times = time_basis(changes);
  const auto surface = page_surface(analysis.responses.nodes, analysis.responses.images, most_nodes);
  const auto places = page_places(analysis);
  const double peak_Pa = analysis.peak.value_Pa;

  Json json = summary::object({{"name", body}});
  add_surface(body, analysis, surface, json, block);
  add_fields(body, analysis, surface, json, block);
  add_modes(
      body, "stress",
      field_modes(stress_fields(analysis, surface, places), sets, stress_tolerance * peak_Pa, most_modes),
      json, block);
  const auto displacements = displacement_fields(analysis, surface);
  constexpr Index samples = 24;
  const double moved_m =
      largest_length(displacements, sets.front(), std::max<Index>(1, sets.front().cols() / samples));
  add_modes(
      body, "displacement",
      field_modes(displacements, {sets.front()}, displacement_tolerance * moved_m, most_displacement_modes),
      json, block);
  json["largest_displacement_m"] = summary::number(moved_m);
  json["peak_Pa"] = summary::number(peak_Pa);
  json["yield_Pa"] = summary::number(analysis.scene.yield_strength_Pa);
  json["zone_level_Pa"] = summary::number(analysis.zones.level_Pa);
  json["channels"] = analysis.responses.channels;
  json["signals"] = signals.channels;
  json["n_signals"] = signals.size();
  json["laws"] = laws_json(signals);
  json["time_rank"] = times.basis.rows();
  block.add(join(body, "basis"), by_rows(times.basis));
  std::vector<float> tables;
  for (const auto& table : times.tables) {
    const auto values = by_rows(table);
    tables.insert(tables.end(), values.begin(), values.end());
  }
  block.add(join(body, "tables"), tables);
  json["places"] = places_json(places, surface.nodes.size(), shown);
  json["arrows"] = arrows_json(analysis);
  add_sections(body, analysis, json, block);
  if (surface.has_corners_only)
    json["notice"] =
        "This body is large: the page shows the corners of its faces alone. envelope.vtu has all of it.";
  return json;
}

}  // namespace pipelines
