/// The key under which unit responses are kept: everything they depend on, as text.
#pragma once

#include <string>
#include <vector>

#include "fem/values/body.h"
#include "fem/values/solver_choice.h"
#include "fem/values/unit_load.h"
#include "fem/values/unit_responses.h"

namespace pipelines {

/// Program, content of the mesh file, charts, material, unit loads, section planes and choice of the solver.
/// Two runs with equal keys have equal unit responses, bit for bit on the same machine.
/// @param mesh_hash  content_hash of the body's mesh file
/// @throws std::logic_error if it is empty: all meshes would have one key
std::string response_key(const fem::Body& body, const std::string& mesh_hash,
                         const std::vector<fem::UnitLoad>& loads,
                         const std::vector<fem::SectionPlane>& planes, fem::Solver solver, int n_threads);

/// Program, content of the mesh file, charts and material: what decides whether the iterative solver
/// converges.
/// @param mesh_hash, @throws  as response_key
std::string body_key(const fem::Body& body, const std::string& mesh_hash);

/// Hash of the running program, so that another build never reuses the results of this one.
const std::string& program_fingerprint();

}  // namespace pipelines
