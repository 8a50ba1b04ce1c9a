#include "pipelines/common/failure.h"

#include <filesystem>

#include "fem/values/errors.h"
#include "kinetics/machine_refused.h"
#include "meshes/values/refused.h"
#include "pipelines/common/errors.h"

namespace pipelines {
namespace {

Failure told(ExitCode code, const std::string& what) {
  return {code, "millstress: " + what};
}

Failure internal(const std::string& what) {
  return told(mesh_or_solve_failed, "internal error, please report it with the scene: " + what);
}

/// Rethrows what is none of these.
Failure users_mistake() {
  try {
    throw;
  } catch (const SceneError& error) {
    return {scene_is_wrong, error.what()};
  } catch (const OptionError& error) {
    return told(scene_is_wrong, error.what());
  } catch (const StageRefused& error) {
    return told(scene_is_wrong, error.what());
  } catch (const kinetics::MachineRefused& error) {
    return told(scene_is_wrong, error.what());
  } catch (const meshes::GeometryRefused& error) {
    return told(scene_is_wrong, error.what());
  } catch (const fem::TooManyModes& error) {
    return told(scene_is_wrong, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return told(scene_is_wrong, error.code().message() + ": " + error.path1().string() +
                                    ": choose another output with -o, or make room for it");
  }
}

/// Rethrows what is none of these.
Failure failed_work() {
  try {
    throw;
  } catch (const ToleranceNotMet& error) {
    return told(tolerance_not_met, error.what());
  } catch (const meshes::MeshRefused& error) {
    return told(mesh_or_solve_failed, error.what());
  } catch (const fem::MeshUnusable& error) {
    return told(mesh_or_solve_failed, error.what());
  } catch (const fem::SolveFailed& error) {
    return told(mesh_or_solve_failed, error.what());
  } catch (const kinetics::LoadsFailed& error) {
    return told(mesh_or_solve_failed, error.what());
  } catch (const LoadsDoNotClose& error) {
    return told(mesh_or_solve_failed, error.what());
  } catch (const NotFinite& error) {
    return told(mesh_or_solve_failed, error.what());
  } catch (const FileError& error) {
    return told(mesh_or_solve_failed, error.what());
  }
}

}  // namespace

Failure failure_in_flight() {
  try {
    try {
      return users_mistake();
    } catch (...) {  // rethrown: of another kind
      return failed_work();
    }
  } catch (const std::exception& error) {
    return internal(error.what());
  } catch (...) {
    return internal("something that is no exception was thrown");
  }
}

}  // namespace pipelines
