# What `cmake --install` leaves works from there: cmake -D BUILD=<build> -D DIRECTORY=<scratch> -P installed.cmake
# Turns red: a scene, page or script that is not installed; a command that the page or a completion lacks; a place of the
# scenes that counts from somewhere else than the program.
cmake_policy(VERSION 3.25)
file(REMOVE_RECURSE ${DIRECTORY})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${DIRECTORY} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
set(program ${DIRECTORY}/bin/millstress)

execute_process(COMMAND ${program} loads shaft --json WORKING_DIRECTORY ${DIRECTORY} OUTPUT_VARIABLE loads ERROR_QUIET
                COMMAND_ERROR_IS_FATAL ANY)
string(JSON pull GET "${loads}" loads pulley.fx max)
if(NOT pull EQUAL 2000)
  message(FATAL_ERROR "shaft, by its name: the belt pulls ${pull} N, not 2000 N")
endif()
execute_process(COMMAND ${program} loads shaftt WORKING_DIRECTORY ${DIRECTORY} RESULT_VARIABLE code ERROR_VARIABLE error)
if(NOT code EQUAL 2 OR NOT error MATCHES "no such file")
  message(FATAL_ERROR "a name that no scene has: exit code ${code}, ${error}")
endif()

execute_process(COMMAND ${program} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE ".*\nSubcommands:\n" "" help "${help}")
string(REGEX MATCHALL "(^|\n)  [a-z-]+" commands "${help}")
list(LENGTH commands n)
if(n LESS 15)
  message(FATAL_ERROR "--help lists ${n} commands: ${help}")
endif()
execute_process(COMMAND gzip -dc ${DIRECTORY}/share/man/man1/millstress.1.gz OUTPUT_VARIABLE page COMMAND_ERROR_IS_FATAL ANY)
set(completion ${DIRECTORY}/share/bash-completion/completions/millstress)
file(READ ${DIRECTORY}/share/fish/vendor_completions.d/millstress.fish fish)
file(READ ${DIRECTORY}/share/zsh/vendor-completions/_millstress zsh)
foreach(command IN LISTS commands)
  string(STRIP "${command}" command)
  string(REPLACE "-" "\\\\-" in_page "${command}")
  if(NOT page MATCHES "\n\\.SS ${in_page}[ \n]" OR NOT fish MATCHES "-a ${command} " OR NOT zsh MATCHES "[ {]${command}[ )]")
    message(FATAL_ERROR "${command} is missing in the manual page or a completion")
  endif()
endforeach()
execute_process(
  COMMAND bash -c "source '${completion}'
    COMP_WORDS=(millstress acc) COMP_CWORD=1 && _millstress && echo \${COMPREPLY[*]}
    COMP_WORDS=(millstress run --tol) COMP_CWORD=2 && _millstress && echo \${COMPREPLY[*]}"
  OUTPUT_VARIABLE completed COMMAND_ERROR_IS_FATAL ANY)
if(NOT completed STREQUAL "accuracy\n--tolerance\n")
  message(FATAL_ERROR "bash completes to ${completed}")
endif()
file(REMOVE_RECURSE ${DIRECTORY})
