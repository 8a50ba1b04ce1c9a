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
/// @throws FileError if the mesh file cannot be read
std::string response_key(const fem::Body& body, const std::vector<fem::UnitLoad>& loads,
                         const std::vector<fem::SectionPlane>& planes, fem::Solver solver, int n_threads);

/// Program, content of the mesh file, charts and material: what decides whether the iterative solver
/// converges.
/// @throws FileError if the mesh file cannot be read
std::string body_key(const fem::Body& body);

/// 128-bit hash of a file's content in hexadecimal digits. @throws FileError if it cannot be read
std::string content_hash(const std::filesystem::path& file);

/// Hash of the running program, so that another build never reuses the results of this one.
const std::string& program_fingerprint();

}  // namespace pipelines
