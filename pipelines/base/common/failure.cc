#include "pipelines/base/common/failure.h"

#include <cerrno>
#include <filesystem>
#include <new>

#include "fem/base/values/errors.h"
#include "kinetics/values/machine_refused.h"
#include "meshes/values/refused.h"
#include "pipelines/base/common/errors.h"

namespace pipelines {
namespace {

Failure told(ExitCode code, const std::string& what) {
  return {code, "millstress: " + what};
}

Failure internal(const std::string& what) {
  return told(mesh_or_solve_failed, "internal error, please report it with the scene: " + what);
}

/// Whether a disk failed at what it could have done with a name that is right.
bool is_fault_of_disk(const std::error_code& code) {
  return code == std::errc::no_space_on_device || code == std::errc::io_error || code.value() == EDQUOT;
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
    if (is_fault_of_disk(error.code())) throw;
    return told(scene_is_wrong,
                error.code().message() + ": " + error.path1().string() + ": choose another output with -o");
  }
}

/// Rethrows what is none of these.
Failure failed_work() {
  try {
    throw;
  } catch (const ToleranceNotMet& error) {
    return told(tolerance_not_met, error.what());
  } catch (const VerdictNotOk& error) {
    return told(verdict_not_ok, error.what());
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
  } catch (const std::bad_alloc&) {
    return told(
        mesh_or_solve_failed,
        "more memory was asked for than this process may have: ask for less accuracy (--tolerance), or "
        "make the mesh coarser");
  } catch (const std::filesystem::filesystem_error& error) {
    return told(mesh_or_solve_failed, error.code().message() + ": " + error.path1().string() +
                                          ": check the free space, or choose another output with -o");
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
