/// deal.II reads DEAL_II_NUM_THREADS while it is loaded, before main, and aborts where that is no number
/// from 1. So it is looked at before libraries are initialised, where nothing of them may be used but system
/// calls.
#include <unistd.h>

#include <cstddef>

#include "pipelines/common/failure.h"

namespace {

constexpr char thread_variable[] = "DEAL_II_NUM_THREADS=";

/// The variable's value; null: not set.
const char* thread_variable_in(char** environment) {
  for (; *environment != nullptr; ++environment) {
    std::size_t i = 0;
    while (thread_variable[i] != 0 && (*environment)[i] == thread_variable[i]) ++i;
    if (thread_variable[i] == 0) return *environment + i;
  }
  return nullptr;
}

bool is_number_from_1(const char* text) {
  constexpr int most_digits = 9;  // fits into an int
  int n_digits = 0, n = 0;
  for (; *text >= '0' && *text <= '9' && n_digits < most_digits; ++text, ++n_digits) n = 10 * n + *text - '0';
  return *text == 0 && n >= 1;
}

void tell(const char* text) {
  std::size_t length = 0;
  while (text[length] != 0) ++length;
  if (write(STDERR_FILENO, text, length) < 0) return;  // then the exit code alone tells
}

void refuse_wrong_thread_variable(int /*argc*/, char** /*argv*/, char** environment) {
  const char* const value = thread_variable_in(environment);
  if (value == nullptr || is_number_from_1(value)) return;
  tell("millstress: DEAL_II_NUM_THREADS = \"");
  tell(value);
  tell(
      "\" in the environment: must be the most threads to use, a whole number from 1; write one, or unset "
      "it\n");
  _exit(pipelines::scene_is_wrong);
}

[[gnu::section(".preinit_array"),
  gnu::used]] void (*const before_libraries)(int, char**, char**) = refuse_wrong_thread_variable;

}  // namespace
