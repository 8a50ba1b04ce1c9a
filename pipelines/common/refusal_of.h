/// Work that a mesher or a solver may refuse, where a refusal is an answer and not the end.
#pragma once

#include <string>
#include <utility>

#include "fem/values/errors.h"
#include "meshes/values/refused.h"

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

}  // namespace pipelines
