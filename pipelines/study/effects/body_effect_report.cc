#include "pipelines/study/effects/body_effect_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/scene/whole/body_effects.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/search/effect_choice/effect_choice.h"

namespace pipelines {
namespace {

using summary::Json;
using Force = GivenForce;

double across_N(const Force& force) {
  return std::hypot(force.force_N[0], force.force_N[1]);
}

std::vector<std::string> texts_of(const Force& force) {
  std::vector<std::string> texts;
  if (across_N(force) > 0)
    texts.push_back(fmt::format("{:.6g} N across, {}, on {}", across_N(force),
                                force.turns_with_shaft ? "turning with the shaft" : "at rest", force.port));
  if (force.force_N[2] != 0)
    texts.push_back(fmt::format("{:.6g} N along the shaft, on {}", force.force_N[2], force.port));
  return texts;
}

/// Forces on one port: those at rest, those that turn with the shaft, those along it.
struct PortForces {
  std::array<double, 2> at_rest_N{}, turning_N{};
  double axial_N = 0;

  void add(const Force& force) {
    auto& across = force.turns_with_shaft ? turning_N : at_rest_N;
    for (std::size_t d = 0; d < 2; ++d) across[d] += force.force_N[d];
    axial_N += force.force_N[2];
  }
  double largest_across_N() const {
    return std::hypot(at_rest_N[0], at_rest_N[1]) + std::hypot(turning_N[0], turning_N[1]);
  }
  double rms_across_N() const {
    return std::hypot(std::hypot(at_rest_N[0], at_rest_N[1]), std::hypot(turning_N[0], turning_N[1]));
  }
};

/// Sums over the forces of the effect on the port; over all that are on where `effect` is empty.
PortForces forces_on(const Scene& scene, const BodyScene& body, const std::string& port,
                     const std::string& effect = "") {
  PortForces sum;
  for (const auto& force : reader_of(body).given_forces(body))
    if (force.port == port && scene.has_effect(force.effect) && (effect.empty() || force.effect == effect))
      sum.add(force);
  return sum;
}

std::vector<LoadShare> shares_on(const Scene& scene, const BodyScene& body, const std::string& port,
                                 const std::string& effect) {
  const auto own = forces_on(scene, body, port, effect), all = forces_on(scene, body, port);
  std::vector<LoadShare> shares;
  const std::string name = body.name + "/" + port;
  if (own.largest_across_N() > 0 && all.largest_across_N() > 0) {
    const double share = own.largest_across_N() / all.largest_across_N();
    shares.push_back({name + ".force", share, own.rms_across_N() / all.rms_across_N(), share});
  }
  if (own.axial_N != 0 && all.axial_N != 0) {
    const double share = std::abs(own.axial_N / all.axial_N);
    shares.push_back({name + ".fz", share, share, share});
  }
  return shares;
}

void add_forces(const Scene& scene, const BodyScene& body, BodyEffect& effect) {
  std::vector<std::string> ports;
  for (const auto& force : reader_of(body).given_forces(body)) {
    if (force.effect != effect.effect.name) continue;
    for (const auto& text : texts_of(force)) effect.forces.push_back(text);
    if (std::find(ports.begin(), ports.end(), force.port) == ports.end()) ports.push_back(force.port);
  }
  for (const auto& port : ports)
    for (const auto& share : shares_on(scene, body, port, effect.effect.name)) effect.shares.push_back(share);
}

std::string where_to_look(const Scene& scene, const std::string& body) {
  return "its size comes from the mesh of the " + body + ": `millstress check " +
         scene.file.filename().string() + " -v` shows it";
}

}  // namespace

FieldTable<LoadShare> load_share_fields() {
  const auto share = [](const char* key, const char* title, const char* meaning, double LoadShare::*of) {
    return FieldOf<LoadShare>(key, quantities::percent, meaning, title,
                              [=](const LoadShare& s) { return summary::number_or_none(s.*of); })
        .digits("{:.3g}");
  };
  return without_csv(FieldTable<LoadShare>{
      share("largest_share", "largest share", "largest size of the part over that of the load",
            &LoadShare::largest),
      share("rms_share", "RMS share", "the same of the root mean squares", &LoadShare::rms),
      share(
          "change_if_off", "change if off",
          "largest change of the load without the effect, over its largest size; null: it cannot be without",
          &LoadShare::if_off),
  });
}

Json load_shares_json(const std::vector<LoadShare>& shares) {
  Json json;
  for (const auto& share : shares) json[share.load] = summary_row(load_share_fields(), share);
  return json;
}

void print_load_shares(std::ostream& out, const std::vector<LoadShare>& shares) {
  print_rows(out, "load", shown_named_rows("load", fields_of(load_share_fields()), load_shares_json(shares)));
}

std::vector<BodyEffect> effects_of_bodies(const Scene& scene) {
  std::vector<BodyEffect> effects;
  for (const auto& body : scene.bodies)
    for (const auto& info : body_effect_table(body)) {
      if (!scene.has_effect(info.name)) continue;
      BodyEffect effect{body.name, info, {}, {}};
      add_forces(scene, body, effect);
      effects.push_back(std::move(effect));
    }
  return effects;
}

void print_effects_of_bodies(std::ostream& out, const Scene& scene, bool all) {
  const auto effects = effects_of_bodies(scene);
  if (!all && !effects.empty()) out << "\n  effects of the bodies themselves\n";
  for (const auto& effect : effects) {
    if (all)
      out << fmt::format("\n  {} on the {}: {} ({})\n", effect.effect.name, effect.body,
                         effect.effect.description, effect.effect.source);
    else
      out << fmt::format("    {} on the {}", effect.effect.name, effect.body);
    const char* begin = all ? "    " : ": ";
    const char* end = all ? "\n" : "";
    if (effect.forces.empty()) out << begin << where_to_look(scene, effect.body) << end;
    for (const auto& force : effect.forces) out << begin << force << end;
    if (!all) {
      for (const auto& share : effect.shares)
        out << fmt::format("; {} of {}", percent(share.largest), share.load);
      out << '\n';
      continue;
    }
    print_load_shares(out, effect.shares);
  }
}

std::string with_effects_of_bodies(const std::string& json, const Scene& scene) {
  const auto effects = effects_of_bodies(scene);
  if (effects.empty()) return json;
  Json whole = Json::parse(json);
  for (const auto& effect : effects) {
    Json entry{
        {"body", effect.body}, {"description", effect.effect.description}, {"source", effect.effect.source}};
    if (effect.forces.empty()) entry["size"] = where_to_look(scene, effect.body);
    for (const auto& force : effect.forces) entry["forces"].push_back(force);
    if (!effect.shares.empty()) entry["loads"] = load_shares_json(effect.shares);
    whole["body_effects"][effect.effect.name] = std::move(entry);
  }
  return whole.dump(2) + "\n";
}

std::vector<EffectSize> effect_sizes(const BodyLoads& loads, const std::vector<RegionMass>& regions) {
  const auto n = loads.history.values.cols();
  std::vector<EffectSize> sizes;
  if (n == 0) return sizes;
  for (std::size_t e = 0; e < loads.history.effects.size(); ++e) {
    Eigen::ArrayXd force_N = Eigen::ArrayXd::Zero(n), moment_Nm = force_N;
    for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
      if (std::holds_alternative<fem::SeatPressure>(loads.unit_loads[k].shape)) continue;
      const UnitSize size = size_of_unit(loads.unit_loads[k], regions);
      const Eigen::ArrayXd values = loads.history.by_effect[e].row(Eigen::Index(k)).abs().transpose();
      force_N += size.force * values;
      moment_Nm += size.moment * values;
    }
    if (force_N.maxCoeff() > 0 || moment_Nm.maxCoeff() > 0)
      sizes.push_back({loads.history.effects[e], force_N.maxCoeff(), moment_Nm.maxCoeff()});
  }
  return sizes;
}

FieldTable<EffectSize> effect_size_fields() {
  return without_csv(FieldTable<EffectSize>{
      {"effect", quantities::text, "that is on", "effects on it, at most", &EffectSize::effect},
      {"force", quantities::force, "of all its forces", "sum of forces", &EffectSize::force_N},
      {"moment", quantities::torque, "of all its moments", "sum of moments", &EffectSize::moment_Nm}});
}

void print_effect_sizes(std::ostream& out, const std::vector<EffectSize>& sizes) {
  print_list(out, effect_size_fields(), sizes);
}

}  // namespace pipelines
