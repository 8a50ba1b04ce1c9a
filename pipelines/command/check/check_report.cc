#include "pipelines/command/check/check_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "pipelines/scene/machines/load_table_reader.h"
#include "pipelines/scene/values/requested_accuracy.h"
#include "pipelines/scene/whole/body_effects.h"
#include "pipelines/write/report/summary.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

/// "about 40 s and 1.6 GB, to 5 % or 60 s" of a scene with bodies.
std::string forecast_text(const CheckReport& report) {
  if (!report.run) return "";
  const auto accuracy = with_default(report.scene.accuracy);
  std::string wanted = accuracy.once ? "the scene's meshes once" : "";
  if (accuracy.tolerance > 0) wanted = fmt::format("to {:.3g} %", 100 * accuracy.tolerance);
  if (accuracy.time_limit_s > 0)
    wanted += fmt::format("{}{:.3g} s", wanted.empty() ? "within " : " or ", accuracy.time_limit_s);
  return fmt::format("; a run takes about {:.2g} s and {:.2g} GB ({}; within a factor of three)",
                     report.run->seconds, report.run->gigabytes, wanted);
}

/// Names between commas, on lines of a hundred columns.
void print_list(std::ostream& out, const std::string& title, const std::vector<std::string>& names) {
  constexpr std::size_t width = 100, indent = 19;
  std::string line = fmt::format("  {:<{}}", title, indent - 2);
  if (names.empty()) line += "none";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto name = names[i] + (i + 1 < names.size() ? "," : "");
    if (line.size() + name.size() > width) {
      out << line << '\n';
      line = std::string(indent, ' ');
    } else if (i > 0) {
      line += ' ';
    }
    line += name;
  }
  out << line << '\n';
}

void print_effect_list(std::ostream& out, const Scene& scene) {
  std::vector<std::string> on, off;
  for (const auto& effect : effect_table(scene))
    (scene.has_effect(effect.name) ? on : off).push_back(effect.name);
  out << '\n';
  print_list(out, fmt::format("effects on, {}", on.size()), on);
  print_list(out, "off", off);
}

void print_effect_table(std::ostream& out, const Scene& scene) {
  out << "\neffects\n";
  for (const auto& effect : effect_table(scene))
    out << fmt::format("  {:<4}{:<24}{} ({})\n", scene.has_effect(effect.name) ? "on" : "off", effect.name,
                       effect.description, effect.source);
}

void print_defaults(std::ostream& out, const Scene& scene) {
  out << "\ndefaults used\n";
  for (const auto& d : scene.defaults) out << fmt::format("  {} = {}  ({})\n", d.key, d.value, d.reason);
  if (scene.defaults.empty()) out << "  none\n";
}

/// The mesh, where it was made.
std::string mesh_text(const CheckedBody& body) {
  if (!body.meshed->model) return "not meshed; --thorough does, and looks for bad cells";
  const auto& quality = body.meshed->mesh.quality;
  return fmt::format("{} cells, scaled Jacobian at least {:.2f}, median {:.2f}; aspect at most {:.0f}",
                     quality.n_cells, quality.min_scaled_jacobian, quality.median_scaled_jacobian,
                     quality.max_aspect);
}

void print_surfaces(std::ostream& out, const CheckedBody& body) {
  const auto& mesh = body.meshed->mesh;
  if (const auto& geometry = body.meshed->geometry_error; body.meshed->model)
    out << fmt::format("  curved faces off by at most {:.2g} of their radius ({} faces)\n", geometry.relative,
                       geometry.n_faces);
  if (mesh.smallest_size_m > 0)
    out << fmt::format("  curvature asks for no edges shorter than {:.2g} mm (smallest_size)\n",
                       mesh.smallest_size_m * 1e3);
  if (const auto& straight = mesh.straight_edges; !straight.empty()) {
    const auto& most = *std::max_element(straight.begin(), straight.end(),
                                         [](const auto& a, const auto& b) { return a.off_m < b.off_m; });
    out << fmt::format(
        "  {} edges between tangent faces are straighter than their surface, by {:.2g} mm at most, at "
        "({:.2f}, "
        "{:.2f}, {:.2f}) mm\n",
        straight.size(), most.off_m * 1e3, most.middle_m[0] * 1e3, most.middle_m[1] * 1e3,
        most.middle_m[2] * 1e3);
  }
}

void print_ports(std::ostream& out, const CheckedBody& body) {
  out << (body.ports_are_known ? "  ports\n"
                               : "  ports that the scene asks for, each with a surface that it may be; "
                                 "--thorough looks for them, and has "
                                 "their channels\n");
  for (const auto& port : body.ports) out << fmt::format("    {:<24}{}\n", port.name, port.where);
}

void print_body(std::ostream& out, const CheckReport& report, const CheckedBody& body, bool all) {
  const auto& model = body.forecast.front();
  const std::string mass = fmt::format("{:.4g} kg", body.meshed->masses.mass_kg);
  if (!all) {
    out << fmt::format("\n{}: {}, {}about {:.2g} unknowns on the scene's mesh; {}\n", body.name, mass,
                       body.ports_are_known ? fmt::format("{} channels, ", body.channels.size()) : "",
                       double(model.n_dofs), mesh_text(body));
    print_ports(out, body);
    return;
  }
  out << fmt::format("\n{}: {}\n", body.name, mesh_text(body));
  print_surfaces(out, body);
  out << "  mass " << mass << (body.ports_are_known ? "\n" : ", by the CAD kernel\n");
  for (const auto& figure : body.masses)
    out << fmt::format("    {:<28}machine {:.5g} {}, mesh and added masses {:.5g}{}\n", figure.name,
                       figure.given, figure.unit, figure.mesh, figure.from_mesh ? " (from the mesh)" : "");
  print_ports(out, body);
  print_forecast(out, *report.scene.body(body.name), *body.meshed, body.forecast);
  if (!body.ports_are_known) return;
  print_effect_sizes(out, body.effects);
  if (!body.instants.empty()) out << "  " << body.instants << '\n';
  out << fmt::format("  {} channels\n", body.channels.size());
  for (const auto& channel : body.channels) out << "    " << channel << '\n';
}

Json json_of(const ModelForecast& model) {
  if (!model.left_out.empty()) return {{"model", model.model}, {"refused", model.left_out}};
  return {{"model", model.model},
          {"unknowns", model.n_dofs},
          {"solve_s", model.solve_s},
          {"superpose_s", model.superpose_s},
          {"gigabytes", model.gigabytes},
          {"solver", model.solver == fem::Solver::automatic   ? "of the model"
                     : model.solver == fem::Solver::iterative ? "conjugate gradients"
                                                              : "factorisation"}};
}

Json json_of(const CheckReport& report, const CheckedBody& body) {
  Json json{{"mass_kg", body.meshed->masses.mass_kg}, {"mesh", nullptr}, {"masses", Json::array()}};
  if (body.meshed->model) {
    const auto& quality = body.meshed->mesh.quality;
    json["mesh"] = {{"cells", quality.n_cells},
                    {"least_scaled_jacobian", quality.min_scaled_jacobian},
                    {"median_scaled_jacobian", quality.median_scaled_jacobian},
                    {"largest_aspect", quality.max_aspect},
                    {"curved_faces_off_by", body.meshed->geometry_error.relative}};
  }
  for (const auto& figure : body.masses)
    json["masses"].push_back({{"name", figure.name},
                              {"unit", figure.unit},
                              {"machine", figure.given},
                              {"mesh", figure.mesh},
                              {"from_mesh", figure.from_mesh}});
  json["ports_are_known"] = body.ports_are_known;
  for (const auto& port : body.ports) json["ports"][port.name] = port.where;
  for (const auto& model : body.forecast) json["forecast"].push_back(json_of(model));
  json["forecast_beside"] = forecast_beside(*report.scene.body(body.name), *body.meshed);
  for (const auto& size : body.effects)
    json["effects"][size.effect] = {{"sum_of_forces_N", size.force_N}, {"sum_of_moments_Nm", size.moment_Nm}};
  json["instants"] = body.instants;
  json["channels"] = body.channels;
  return json;
}

}  // namespace

void print_check(std::ostream& out, const CheckReport& report, bool all) {
  const auto& scene = report.scene;
  out << scene.file.string() << ": the scene is valid" << forecast_text(report) << '\n';
  if (all)
    print_effect_table(out, scene), print_defaults(out, scene);
  else
    print_effect_list(out, scene);
  const auto samples = samples_read(scene.machine, scene.sampling);
  if (!samples.empty()) out << "\nsamples read\n";
  for (const auto& of_effect : samples) out << "  " << of_effect.text() << '\n';
  print_effect_choice(out, scene, {});
  for (const auto& body : report.bodies) print_body(out, report, body, all);
  for (const auto& block : report.blocks) out << "\nblock " << block << '\n';
  out << '\n';
  for (const auto* warnings : {&scene.warnings, &report.warnings})
    for (const auto& warning : *warnings) out << "warning: " << warning << '\n';
  if (!all)
    out << fmt::format(
        "{} defaults used; these, masses, forecasts of each model, sizes of effects, channels: -v, "
        "--json\n",
        scene.defaults.size());
}

std::string check_json(const CheckReport& report) {
  const auto& scene = report.scene;
  Json json{{"scene", scene.file.filename().string()}, {"valid", true}};
  if (!scene.settings.empty()) json["settings"] = scene.settings;
  if (report.run)
    json["run"] = {{"seconds", report.run->seconds},
                   {"gigabytes", report.run->gigabytes},
                   {"ends_by_limit", report.run->ends_by_limit}};
  for (const auto& effect : effect_table(scene))
    json["effects"][effect.name] = {{"on", scene.has_effect(effect.name)},
                                    {"description", effect.description},
                                    {"source", effect.source}};
  json["defaults"] = Json::array();
  for (const auto& d : scene.defaults)
    json["defaults"].push_back({{"key", d.key}, {"value", d.value}, {"reason", d.reason}});
  for (const auto& of_effect : samples_read(scene.machine, scene.sampling))
    json["samples"].push_back(of_effect.text());
  for (const auto& dropped : scene.effect_choice.dropped)
    json["dropped_effects"][dropped.effect] = dropped.share;
  for (const auto& body : report.bodies) json["bodies"][body.name] = json_of(report, body);
  for (const auto& block : report.blocks) json["blocks"].push_back(block);
  json["warnings"] = scene.warnings;
  for (const auto& warning : report.warnings) json["warnings"].push_back(warning);
  return json.dump(2) + "\n";
}

}  // namespace pipelines
