/// The free body of a vibratory mill's chamber as table, JSON, CSV and an animation over the turn.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "kinetics/free_body.h"
#include "pipelines/base/fields/field.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// A load at an instant.
struct FreeBodyRow {
  const kinetics::FreeBody& body;
  const kinetics::FreeBodyLoad& load;
  Eigen::Index instant;
};

/// free_body.csv.
FieldTable<FreeBodyRow> free_body_fields();

/// The free body over the first turn of the drive, at the scene's instants.
/// @throws StageRefused if the scene's machine is no vibratory mill, or runs up; as kinetics does
kinetics::FreeBody free_body(const Scene& scene);

/// The instant whose drive angle is nearest to one given, turns aside.
Eigen::Index instant_at(const kinetics::FreeBody& body, double angle_rad);

/// What is left of forces and moments, as shares of the largest at any instant.
struct FreeBodyClosure {
  double force = 0, moment = 0;
};
FreeBodyClosure closure_of(const kinetics::FreeBody& body);

/// @param json  as JSON instead of a table
void print_free_body(std::ostream& out, const Scene& scene, const kinetics::FreeBody& body,
                     Eigen::Index instant, bool json);

/// The inner radius of the chamber, where the scene tells it.
std::optional<double> chamber_radius_m(const Scene& scene);

/// Writes free_body.csv, free_body.pvd, free_body_000.vtp, ...: a row per instant and load; per instant the
/// loads' points with the vector field "force [N]", and as lines the chamber, and the bodies' links from the
/// eccentric to chamber's centre and springs, at their places in that instant, from the shaft's axis.
void write_free_body(const std::filesystem::path& directory, const Scene& scene,
                     const kinetics::FreeBody& body);

}  // namespace pipelines
