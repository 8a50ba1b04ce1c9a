/// Work that a mesher or a solver may refuse, where a refusal is an answer and not the end.
#pragma once

#include <string>
#include <utility>

#include "fem/base/values/errors.h"
#include "kinetics/values/machine_refused.h"
#include "meshes/values/refused.h"
#include "pipelines/base/common/errors.h"

namespace pipelines {

/// @return why a mesh was refused or could not be solved; empty if the work was done
/// @throws anything else that the work throws
template <typename Work>
std::string refusal_of(Work&& work) {
  try {
    std::forward<Work>(work)();
    return {};
  } catch (const meshes::GeometryRefused& error) {
    return error.what();
  } catch (const meshes::MeshRefused& error) {
    return error.what();
  } catch (const fem::MeshUnusable& error) {
    return error.what();
  } catch (const fem::SolveFailed& error) {
    return error.what();
  }
}

/// Does the work; what kinetics refuses, and figures that are not finite, then begin with a place in the
/// scene: its numbers alone make them.
/// @throws kinetics::MachineRefused or StageRefused "place: what", and anything else that the work throws
template <typename Work>
auto with_place(const std::string& place, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const kinetics::MachineRefused& error) {
    throw kinetics::MachineRefused(place + ": " + error.what());
  } catch (const NotFinite& error) {
    throw StageRefused(place + ": " + error.what());
  }
}

}  // namespace pipelines
