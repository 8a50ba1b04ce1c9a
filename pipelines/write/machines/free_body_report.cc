#include "pipelines/write/machines/free_body_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/write/exports/vtk_arrows.h"
#include "pipelines/write/exports/vtk_files.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Point = std::array<double, 3>;

double angle_in_turn_deg(double angle_rad) {
  const double turns = angle_rad / (2 * pi);
  return 360 * (turns - std::floor(turns));
}

/// Moment of a load about E', counter-clockwise.
double moment_N_m(const kinetics::FreeBodyLoad& load, Index i) {
  return load.at_m(0, i) * load.force_N(1, i) - load.at_m(1, i) * load.force_N(0, i) + load.couple_N_m[i];
}

Point in_space(const kinetics::FreeBody& body, const Eigen::Array2Xd& at_m, Index i) {
  return {body.pivot_m(0, i) + at_m(0, i), body.pivot_m(1, i) + at_m(1, i), 0};
}

Point in_space(const kinetics::FreeBody& body, const Eigen::Vector2d& at_m, Index i) {
  return {body.pivot_m(0, i) + at_m[0], body.pivot_m(1, i) + at_m[1], 0};
}

std::string snapshot_name(Index i) {
  return fmt::format("free_body_{:03}.vtp", i);
}

std::vector<FreeBodyRow> rows_at(const kinetics::FreeBody& body, Index i) {
  std::vector<FreeBodyRow> rows;
  for (const auto& load : body.loads) rows.push_back({body, load, i});
  return rows;
}

std::vector<std::vector<Point>> outlines(const Scene& scene, const kinetics::FreeBody& body, Index i) {
  const auto& mill = scene.vibratory_mill();
  const Point pivot = in_space(body, Eigen::Vector2d::Zero().eval(), i);
  std::vector<std::vector<Point>> lines{{{0, 0, 0}, pivot},
                                        {pivot, in_space(body, mill.chamber_centre_m, i)}};
  for (const auto& spring : mill.springs) lines.push_back({pivot, in_space(body, spring.position_m, i)});
  if (const auto radius_m = chamber_radius_m(scene)) {
    constexpr int n = 72;
    lines.emplace_back();
    for (int k = 0; k <= n; ++k) {
      const double angle = 2 * pi * (k % n) / n;
      lines.back().push_back(
          in_space(body,
                   Eigen::Vector2d(mill.chamber_centre_m +
                                   *radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle))),
                   i));
    }
  }
  return lines;
}

}  // namespace

FieldTable<FreeBodyRow> free_body_fields() {
  using Field = FieldOf<FreeBodyRow>;
  return {
      {"time", quantities::time, "of the instant", [](const auto& r) { return r.body.time_s[r.instant]; }},
      {"drive_angle", quantities::angle, "of the instant",
       [](const auto& r) { return r.body.phi_rad[r.instant]; }},
      {"load", quantities::text, "its name", "load, from the eccentric's axis",
       [](const auto& r) { return r.load.name; }},
      {"x", quantities::length, "where it acts", "x",
       [](const auto& r) { return r.load.at_m(0, r.instant); }},
      {"y", quantities::length, "where it acts", "y",
       [](const auto& r) { return r.load.at_m(1, r.instant); }},
      {"fx", quantities::force, "component", "fx",
       [](const auto& r) { return r.load.force_N(0, r.instant); }},
      {"fy", quantities::force, "component", "fy",
       [](const auto& r) { return r.load.force_N(1, r.instant); }},
      Field("force", quantities::force, "its size, on the terminal alone", "force",
            [](const auto& r) {
              return std::hypot(r.load.force_N(0, r.instant), r.load.force_N(1, r.instant));
            })
          .without_csv(),
      {"couple", quantities::torque, "that acts beside the force",
       [](const auto& r) { return r.load.couple_N_m[r.instant]; }},
      {"moment", quantities::torque, "of both about the eccentric's axis", "moment",
       [](const auto& r) { return moment_N_m(r.load, r.instant); }},
  };
}

kinetics::FreeBody free_body(const Scene& scene) {
  const auto* mill = std::get_if<kinetics::VibratoryMill>(&scene.machine);
  if (mill == nullptr)
    throw StageRefused(scene.machine_type_at +
                       ": free-body needs a scene whose machine.type is \"vibratory_mill\"");
  if (scene.run_up)
    throw StageRefused(
        scene.machine_type_at +
        ": free-body is drawn of steady running; take machine.run_up away: --set machine.run_up=removed");
  return kinetics::chamber_free_body(*mill, scene.kinetics_effects(), {1, scene.sampling.instants_per_turn});
}

Index instant_at(const kinetics::FreeBody& body, double angle_rad) {
  Index nearest = 0;
  (body.phi_rad - angle_rad).cos().maxCoeff(&nearest);
  return nearest;
}

FreeBodyClosure closure_of(const kinetics::FreeBody& body) {
  double force_N = 0, largest_N_m = 0;
  for (const auto& load : body.loads)
    for (Index i = 0; i < body.time_s.size(); ++i) {
      force_N = std::max(force_N, std::hypot(load.force_N(0, i), load.force_N(1, i)));
      largest_N_m = std::max(largest_N_m, std::abs(moment_N_m(load, i)));
    }
  FreeBodyClosure closure;
  if (force_N > 0) closure.force = body.force_sum_N().abs().maxCoeff() / force_N;
  if (largest_N_m > 0) closure.moment = body.moment_sum_N_m().abs().maxCoeff() / largest_N_m;
  return closure;
}

void print_free_body(std::ostream& out, const Scene& scene, const kinetics::FreeBody& body, Index instant,
                     bool json) {
  const auto closure = closure_of(body);
  const double angle_deg = angle_in_turn_deg(body.phi_rad[instant]);
  if (json) {
    nlohmann::ordered_json all{{"drive_angle_rad", body.phi_rad[instant]}, {"time_s", body.time_s[instant]}};
    for (const auto& load : body.loads)
      all["loads"].push_back({{"name", load.name},
                              {"at_m", {load.at_m(0, instant), load.at_m(1, instant)}},
                              {"force_N", {load.force_N(0, instant), load.force_N(1, instant)}},
                              {"couple_N_m", load.couple_N_m[instant]},
                              {"moment_N_m", moment_N_m(load, instant)}});
    all["closure"] = {{"force", closure.force}, {"moment", closure.moment}};
    out << all.dump(2) << '\n';
    return;
  }
  out << fmt::format("\n{}: the chamber's free body at {:.4g} deg of the drive, clockwise\n", scene.title,
                     angle_deg);
  print_list(out, free_body_fields(), rows_at(body, instant));
  const Eigen::Array2Xd sum_N = body.force_sum_N();
  out << fmt::format("  in sum {:.5g} N, {:.5g} N, {:.5g} N m\n", sum_N(0, instant), sum_N(1, instant),
                     body.moment_sum_N_m()[instant]);
  out << fmt::format("\n  over the turn forces close to {:.2g} of the largest, moments to {:.2g}{}\n",
                     closure.force, closure.moment,
                     closure.moment > 1e-9 ? ": without the effect pitch a guide takes the rest" : "");
}

std::optional<double> chamber_radius_m(const Scene& scene) {
  for (const auto& body : scene.bodies)
    if (const auto* chamber = std::get_if<ChamberShape>(&body.shape))
      return chamber->geometry.tube.inner_radius_m;
  if (scene.milling_space) return scene.milling_space->inner_radius_m;
  return std::nullopt;
}

void write_free_body(const std::filesystem::path& directory, const Scene& scene,
                     const kinetics::FreeBody& body) {
  std::vector<PvdEntry> entries;
  std::vector<FreeBodyRow> rows;
  for (Index i = 0; i < body.time_s.size(); ++i) {
    std::vector<PlacedVector> vectors;
    for (const auto& load : body.loads)
      vectors.push_back(
          {load.name, in_space(body, load.at_m, i), {load.force_N(0, i), load.force_N(1, i), 0}});
    write_arrows_vtp(directory / snapshot_name(i), "force [N]", vectors, outlines(scene, body, i));
    entries.push_back({body.time_s[i], snapshot_name(i), ""});
    for (const auto& row : rows_at(body, i)) rows.push_back(row);
  }
  write_pvd(directory / "free_body.pvd", entries);
  write_csv(directory / "free_body.csv",
            csv_columns(fields_of(free_body_fields()), whole_rows(free_body_fields(), rows)));
}

}  // namespace pipelines
