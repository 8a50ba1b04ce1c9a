# Writes commit.h with the commit of a source tree, nothing for one that is no clone: cmake -D ROOT=<source> -D FILE=<commit.h> -P commit.cmake
set(commit "")
if(EXISTS "${ROOT}/.git")
  execute_process(COMMAND git -C "${ROOT}" describe --always --abbrev=12 --exclude=* --dirty=+
                  OUTPUT_VARIABLE described ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(described)
    set(commit " (commit ${described})")
  endif()
endif()
file(CONFIGURE OUTPUT "${FILE}" CONTENT "#define MILLSTRESS_COMMIT \"${commit}\"\n" @ONLY)
