# Holds the walls between the folders: cmake -D ROOT=<source tree> -P include_walls.cmake
# kinetics, meshes and fem never include each other or pipelines; headers of gmsh, deal.II and VTK stay in the .cc files of
# the folder that owns them (internal headers of fem may use deal.II, its public ones may not). pipelines includes only public
# headers of fem. Inside a folder, a room (subfolder) includes only rooms below it.
cmake_policy(VERSION 3.25)
set(fem_public axisymmetric_responses beam_responses blas_kernels beam_shaft body body_nodes cell_shares cell_stress_at_node constants
    cost_constants cost_prediction deadline errors fillet_factors memory meridian_body model natural_mode
    near_loads nodal_loads plated_tube ranks region_volume rotor solver_choice stress_goal submodel surface_stress tetrahedra_error
    unit_load unit_responses vtk_order)
set(faults "")

# Adds a fault for every line of the files that matches.
function(forbid pattern why)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*${pattern}")
    foreach(line IN LISTS lines)
      list(APPEND faults "${file}: ${line}: ${why}")
    endforeach()
  endforeach()
  set(faults "${faults}" PARENT_SCOPE)
endfunction()

set(others_kinetics "meshes|fem|pipelines|tests")
set(others_meshes "kinetics|fem|pipelines|tests")
set(others_fem "kinetics|meshes|pipelines|tests")
set(others_pipelines "tests")
foreach(folder kinetics meshes fem pipelines)
  file(GLOB_RECURSE headers ${ROOT}/${folder}/*.h)
  file(GLOB_RECURSE sources ${ROOT}/${folder}/*.cc)
  if(NOT headers OR NOT sources)
    message(FATAL_ERROR "${ROOT}/${folder} holds no code: nothing was checked")
  endif()
  forbid("[\"<](${others_${folder}})/" "${folder} must not know this folder" ${headers} ${sources})
  list(FILTER headers EXCLUDE REGEX "/fem/equations/matrices/petsc_session\\.h$")  # for .cc files that are compiled by themselves
  forbid("[\"<](gmsh\\.h|vtk|hdf5\\.h|slepc|petsc)" "keep this library out of headers" ${headers})
  if(NOT folder STREQUAL "meshes")
    forbid("[\"<]gmsh\\.h" "only meshes uses gmsh" ${sources})
  endif()
  if(NOT folder STREQUAL "fem")
    forbid("[\"<]deal\\.II/" "only fem uses deal.II" ${headers} ${sources})
  endif()
endforeach()
foreach(name IN LISTS fem_public)
  file(GLOB header ${ROOT}/fem/*/*/${name}.h)
  if(NOT header)
    list(APPEND faults "${ROOT}/fem/*/*/${name}.h is missing: keep the list of public headers up to date")
    continue()
  endif()
  forbid("[\"<](deal\\.II/|Eigen/|cholmod)" "public headers of fem are plain values" ${header})
endforeach()
file(GLOB_RECURSE files ${ROOT}/pipelines/*.h ${ROOT}/pipelines/*.cc)
foreach(file IN LISTS files)
  file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<]fem/")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE ".*/([a-z0-9_]+)\\.h.*" "\\1" name "${line}")
    if(NOT name IN_LIST fem_public)
      list(APPEND faults "${file}: ${line}: this header of fem is not public")
    endif()
  endforeach()
endforeach()

# Rooms from the ground floor up: a room includes only itself and rooms before it. Those of fem and pipelines lie in wings, a line
# each.
set(rooms_fem
    base/values base/common
    mesh/grid mesh/triangulation mesh/ranks
    equations/matrices equations/operators equations/loads
    stress/cells stress/recovery
    solve/solvers solve/modes
    refine/submodel refine/adaptivity
    models/beam models/axisymmetric models/solid)
set(rooms_kinetics values series vibratory_effects vibratory planetary_effects planetary torsion_chain torsion table)
set(rooms_meshes values gmsh spacing checks shaft_layout shaft chamber solids keyed_shaft imported)
set(rooms_pipelines
    base/common base/disk base/fatigue base/names base/files base/fields
    scene/materials scene/values scene/whole scene/bodies scene/kinds scene/tables scene/reader scene/machines
    loads/channels loads/stage loads/bodies
    respond/responses
    superpose/kernels superpose/envelope superpose/between_instants
    judge/estimates judge/figures judge/analysis judge/stages judge/life judge/texts judge/verdict
    search/cheap_models search/effect_choice search/refinement search/models search/loop
    write/drawing write/exports write/fields write/machines write/parts write/pictures write/living write/report write/files
    study/effects study/variations study/accuracy study/sweep study/optimum study/comparison
    command/front command/calculix command/options command/check command/commands command/study)
foreach(folder fem kinetics meshes pipelines)
  set(above ${rooms_${folder}})
  foreach(room IN LISTS rooms_${folder})
    list(REMOVE_AT above 0)
    file(GLOB files ${ROOT}/${folder}/${room}/*.h ${ROOT}/${folder}/${room}/*.cc)
    if(NOT files)
      list(APPEND faults "${ROOT}/${folder}/${room} holds no code: keep the list of rooms up to date")
    endif()
    list(LENGTH files n_files)
    if(n_files GREATER 20)
      list(APPEND faults "${ROOT}/${folder}/${room} holds ${n_files} files: a room has at most 20")
    endif()
    if(above)
      list(JOIN above "|" names)
      forbid("\"${folder}/(${names})/" "the room ${folder}/${room} must not know this room above it" ${files})
    endif()
  endforeach()
  file(GLOB strays ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cc)
  list(FILTER strays EXCLUDE REGEX "/precompiled[a-z_]*\\.h$|/kinetics/[a-z_]+\\.(h|cc)$")  # kinetics: what its machines offer
  foreach(stray IN LISTS strays)
    list(APPEND faults "${stray} lies in no room")
  endforeach()
  file(GLOB rooms RELATIVE ${ROOT}/${folder} ${ROOT}/${folder}/*/*.h ${ROOT}/${folder}/*/*/*.h)
  foreach(file IN LISTS rooms)
    get_filename_component(room ${file} DIRECTORY)
    if(NOT room IN_LIST rooms_${folder})
      list(APPEND faults "${ROOT}/${folder}/${room} is not in the list of rooms")
    endif()
  endforeach()
endforeach()

# Tests, and what kinetics offers, lie no denser.
file(GLOB_RECURSE files ${ROOT}/tests/*.h ${ROOT}/tests/*.cc)
list(FILTER files EXCLUDE REGEX "/tests/data/")
file(GLOB fronts ${ROOT}/kinetics/*.h ${ROOT}/kinetics/*.cc)
list(APPEND files ${fronts})
list(TRANSFORM files REPLACE "/[^/]*$" "" OUTPUT_VARIABLE rooms)
list(REMOVE_DUPLICATES rooms)
foreach(room IN LISTS rooms)
  file(GLOB files ${room}/*.h ${room}/*.cc)
  list(LENGTH files n_files)
  if(n_files GREATER 20)
    list(APPEND faults "${room} holds ${n_files} files: a room has at most 20")
  endif()
endforeach()

if(faults)
  list(JOIN faults "\n" text)
  message(FATAL_ERROR "${text}")
endif()
