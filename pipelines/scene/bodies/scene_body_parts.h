/// Ports that a body will have, known from its scene before it is meshed: what a table names is checked
/// there, with a line.
#pragma once

#include <string>
#include <vector>

#include "pipelines/scene/bodies/scene_body.h"

namespace pipelines {

/// Known from the scene, before meshing.
struct BodyPorts {
  std::vector<std::string> round;  ///< seats and bores: pressure goes round them
  std::vector<std::string> all;    ///< with end faces, pads, covers; none: only the mesher knows
};

BodyPorts ports_of(const BodyScene& body);

/// Reports, at `key` of the table, a port that is not among the known ones; silent if there are none, or no
/// port was readable.
/// @param what_known  "the ports of this body"
void check_port(SceneTable& table, const std::string& key, const std::string& port,
                const std::vector<std::string>& known, const std::string& what_known);

/// The tables [<body>.pressure.<port>] and pressure_harmonics; after the shape.
void read_pressures(SceneTable& table, BodyScene& body);

}  // namespace pipelines
