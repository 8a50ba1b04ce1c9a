/// Five shafts whose largest stress is known, as STEP files: what a user brings, and what is true of it.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace step_shafts {

struct Segment {
  std::string name;
  double diameter_mm = 0, length_mm = 0;
  bool is_port = false;
};

struct StepShaft {
  std::string name;
  std::vector<Segment> segments;   ///< along z from 0
  std::vector<double> fillets_mm;  ///< one per junction; 0: none, between equal diameters
  double bore_mm = 0;              ///< diameter, right through
  std::string loads;               ///< tables of the scene's machine
  std::string supports;            ///< lines of the body
  /// The largest von Mises stress by the axisymmetric model of degree 3, cells halved until it moves by less
  /// than 1 % (of which a tenth is missing still): tests/benchmarks/run step_parts computes it anew.
  double von_mises_MPa = 0;
  /// Of published tables (P08: largest shear, P09: largest principal stress), times the nominal stress; 0
  /// where no table has the shaft.
  double known_MPa = 0;
  bool known_is_shear = false;
};

/// Shoulder fillets in torsion, bending and tension, a groove in bending, a hollow shaft in torsion and
/// bending.
std::vector<StepShaft> all();

/// Calls draw in a session of gmsh of its own and writes what it left.
void write_drawn(const std::filesystem::path& file, const std::function<void()>& draw);

/// Joins solids of gmsh's model to one.
void fuse(const std::vector<int>& tags);

/// [sampling] and [results] of a scene that writes no more than its stresses.
std::string one_turn(int n_instants);

/// A port of body "part": the face within a box, whose corners are given in millimetres.
std::string box_port(const std::string& name, const std::array<double, 3>& low,
                     const std::array<double, 3>& high);

/// The solid by OpenCASCADE, in millimetres.
void write_step(const StepShaft& shaft, const std::filesystem::path& file);

/// The STEP file `<name>.step` as body "part".
std::string scene_of_step(const StepShaft& shaft, const std::string& mesh_keys);

/// The same drawing as body "shaft" of blocks.
std::string scene_of_blocks(const StepShaft& shaft);

}  // namespace step_shafts
