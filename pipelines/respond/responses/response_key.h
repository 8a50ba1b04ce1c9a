/// The key under which unit responses are kept: everything they depend on, as text.
#pragma once

#include <string>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/solver_choice.h"
#include "fem/base/values/unit_load.h"
#include "fem/base/values/unit_responses.h"

namespace pipelines {

/// Program, mesh, charts, material, unit loads, section planes and choice of the solver.
/// Two runs with equal keys have equal unit responses, bit for bit on the same machine.
/// @throws std::logic_error for a body without a mesh: all of them would have one key
std::string response_key(const fem::Body& body, const std::vector<fem::UnitLoad>& loads,
                         const std::vector<fem::SectionPlane>& planes, fem::Solver solver, int n_threads);

/// A unit load as text: the same text, the same load to the last bit.
std::string load_key(const fem::UnitLoad& load);

/// Hash of the running program, so that another build never reuses the results of this one.
const std::string& program_fingerprint();

}  // namespace pipelines
