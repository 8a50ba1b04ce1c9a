#include "fem/equations/matrices/petsc_session.h"

#include <cctype>
#include <cstdlib>
#include <sstream>
#include <type_traits>
#include <utility>

#include "fem/base/values/errors.h"

namespace fem {

static_assert(std::is_same_v<PetscScalar, double>, "PETSc and SLEPc of real numbers in double precision");

namespace {

std::mutex& petsc_in_use() {
  static std::mutex mutex;
  return mutex;
}

PetscErrorCode keep_first_message(MPI_Comm, int, const char*, const char*, PetscErrorCode code,
                                  PetscErrorType, const char* text, void* message) {
  auto& first = *static_cast<std::string*>(message);
  if (first.empty() && text != nullptr) first = text;
  return code;
}

}  // namespace

PetscSession::PetscSession(std::string failure, const std::string& options)
    : lock_(petsc_in_use()), failure_(std::move(failure)) {
  if (SlepcInitializeCalled == PETSC_FALSE) {
    PETSC_COMM_WORLD = MPI_COMM_SELF;
    check(SlepcInitializeNoArguments());
    PetscPopSignalHandler();
  }
  PetscPushErrorHandler(keep_first_message, &message_);
  PetscOptionsCreate(&options_);
  PetscOptionsInsertString(options_, options.c_str());
  PetscOptionsPush(options_);
}

PetscSession::~PetscSession() {
  PetscOptionsPop();
  PetscOptionsDestroy(&options_);
  PetscPopErrorHandler();
}

void PetscSession::check(PetscErrorCode code) const {
  if (code == 0) return;
  if (code == PETSC_ERR_MEM) throw DoesNotFit(failure_ + ": PETSc found no memory, " + message_);
  throw SolveFailed(failure_ + ": PETSc's error " + std::to_string(code) + ", " + message_);
}

std::string petsc_options_of_user(const std::string& prefix) {
  const char* all = std::getenv("PETSC_OPTIONS");
  if (all == nullptr) return "";
  std::istringstream words(all);
  std::string options, word;
  bool is_ours = false;
  while (words >> word) {
    if (word.size() > 1 && word[0] == '-' && std::isalpha(word[1]) != 0)
      is_ours = word.rfind("-" + prefix, 0) == 0;
    if (is_ours) options += ' ' + word;
  }
  return options;
}

}  // namespace fem
