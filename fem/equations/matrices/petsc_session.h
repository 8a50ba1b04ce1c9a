/// PETSc and SLEPc: their start, options and errors. Internal to fem; this header is for .cc files that are
/// compiled by themselves (CMakeLists.txt), since PETSc's names are global.
#pragma once

#include <slepceps.h>

#include <mutex>
#include <string>

namespace fem {

/// While it lives, PETSc belongs to this thread, with the session's options alone. fem::Environment starts
/// PETSc as a part of deal.II. In a program that has no Environment the first session starts it for the rest
/// of the process.
class PetscSession {
public:
  /// @param failure  what its messages of failure begin with
  /// @param options  as on PETSc's command line
  explicit PetscSession(std::string failure, const std::string& options = "");
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

  /// @throws SolveFailed with PETSc's first message if a call failed; DoesNotFit if it found no memory
  void check(PetscErrorCode code) const;

private:
  std::unique_lock<std::mutex> lock_;  // options and handlers are those of the process
  PetscOptions options_ = nullptr;
  std::string failure_, message_;
};

/// The options of the environment's PETSC_OPTIONS that begin with `-prefix`, with their values. Others are
/// meant for other programs.
std::string petsc_options_of_user(const std::string& prefix);

/// A PETSc object that is destroyed with its handle.
template <typename Object, auto destroy>
struct PetscHandle {
  Object object = nullptr;
  PetscHandle() = default;
  ~PetscHandle() { destroy(&object); }
  PetscHandle(const PetscHandle&) = delete;
  PetscHandle& operator=(const PetscHandle&) = delete;
};
using PetscMatrix = PetscHandle<Mat, MatDestroy>;
using PetscVector = PetscHandle<Vec, VecDestroy>;

}  // namespace fem
