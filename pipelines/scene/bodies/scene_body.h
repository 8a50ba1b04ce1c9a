/// The tables of a scene's bodies: [shaft], [chamber], [drum], [axle], [part].
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

class BodyReader;

/// What a contour may hold, by the kind of body.
struct ContourRules {
  std::vector<std::string> ports;  ///< load enters at each of them: all are needed
  bool any_port = false;           ///< the user's own ports beside them
  /// z = 0 in the middle of the segment with this port or bore port; empty: at the left end.
  std::string middle;
  std::string eccentric_seat;  ///< takes its eccentricity from the drive; empty: no such seat
  double eccentricity_m = 0;   ///< eccentricity of the drive
};

/// Reads contour, begin and [mesh]. The contour reads like the drawing, from left to right:
///   contour = [ { name = "body_1", diameter = "42 mm", length = "138.5 mm" },
///               { fillet = "2.5 mm" },
///               { port = "eccentric_seat", diameter = "60 mm", length = "60 mm" }, ... ]
/// A fillet stands between the two segments whose shoulder it rounds. A segment has either a name, or the
/// name of the port where load enters it; a bore may be a port too.
/// @return values in SI; NaN where one could not be read, with an error in the findings
ShaftShape read_shaft_shape(SceneTable& body, const ContourRules& rules, SceneFindings& findings);

/// Reads tube, flanges, housing, webs, feet and mesh of the vibratory mill's chamber; its axis and the places
/// of its feet come from the machine.
ChamberShape read_chamber_shape(SceneTable& body, const kinetics::VibratoryMill& mill,
                                const std::optional<MillingSpace>& space);

/// Reads file, length_unit, ports and mesh of a body of the user's own geometry.
meshes::Import read_import(SceneTable& body, const std::filesystem::path& scene_directory,
                           const std::vector<std::string>& needed_ports);

/// Reads [[keyways]], if there are any.
std::vector<meshes::Keyway> read_keyways(SceneTable& body);

/// How a body of tetrahedra is meshed.
meshes::SolidControl read_solid_control(SceneTable mesh);

/// Reads the body's table as a whole and closes it.
/// @param scene  with its machine read
BodyScene read_body(SceneTable& table, const BodyReader& kind, const Scene& scene, SceneFindings& findings);

/// Reads the tables of all bodies that the scene's machine may have into scene.bodies; refuses those of other
/// machines.
/// @return the tables of scene.bodies
std::vector<SceneTable> read_bodies(SceneTable& root, Scene& scene, SceneFindings& findings);

}  // namespace pipelines
