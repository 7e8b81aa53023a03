# Compiler settings, and the functions with which each folder declares its targets.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# Two shared libraries that define the same generated class must not see each other's symbols.
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

# All programs are built into one folder, because the launcher looks for the other programs beside itself.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

option(SKEIN_UNITY "Compile the files of a folder together; OFF: each alone, for faster rebuilds after edits" ON)
set(SKEIN_SANITIZE OFF CACHE STRING "Build with sanitizers: address (and undefined behaviour), thread, or OFF")
# The tests that run with ThreadSanitizer: those of code with threads, of both vendors' buses, and of whole fleets over
# the inproc bus. ThreadSanitizer ignores what happens between threads of the vendors' libraries (tsan.supp).
set(SKEIN_THREAD_TESTS bus_inbox_test bus_unsent_test process_program_test process_status_pipe_test
  one_process_crew_test one_process_flights_test one_process_digests_test bus_contract_test radio_contract_test
  view_server_test)

# Slow tests: a third of the tests of these entries runs at each commit, because each entry takes more than half a
# minute.
set(SKEIN_SLOW_TESTS agent_planner_contract_test agent_planners_kios_kios_test agent_planners_patrol_patrol_test
  agent_planners_star_star_flight_test agent_planners_xxh_xxh_test agent_published_strategies_test bus_contract_test
  oracle_oracle_test scenes_scene_families_test scenes_wild_flood_test)

# Tests that are slow with sanitizers: an eighth of the tests of these entries runs at each commit.
set(SKEIN_SLOW_SANITIZED_TESTS oracle_oracle_test sim_plan_flight_test sim_plan_plan_test
  scenes_scene_families_test agent_planner_contract_test
  sim_wild_world_test sim_whole_simulation_test sim_flight_dynamics_test sight_ray_fan_test
  sim_exchange_period_test sim_flight_fleet_start_test scenes_enclosure_test sim_flight_vehicle_test
  sim_flight_vehicle_faults_test oracle_best_aim_test oracle_open_space_test sight_ray_scene_test
  scenes_scene_digests_test scenes_scene_export_test scenes_scene_source_test report_run_report_test
  agent_planners_kios_kios_test agent_planners_patrol_patrol_test agent_planners_star_star_flight_test
  agent_planners_xxh_xxh_test agent_published_strategies_test agent_flight_core_safety_filter_test
  cli_compose_compose_file_test one_process_digests_test protocol_test)
# Of these, a third runs at each commit: they test code in which sanitizers are most likely to find defects.
set(SKEIN_SANITIZED_TESTS_IN_THREE bus_contract_test radio_contract_test)

# -ffp-contract=off: no fused multiply-add, so that results do not depend on where the optimiser would use it.
# Never -march=native: one binary gives the same bits on every x86-64 machine.
# -Wno-restrict: GCC 12 warns of overlaps in operator+ of a literal and a std::string that do not exist.
add_compile_options(-Wall -Wextra -Wshadow -Wno-psabi -Wno-restrict -ffp-contract=off)
if(SKEIN_SANITIZE)
  set(sanitizers address,undefined)
  if(SKEIN_SANITIZE STREQUAL thread)
    set(sanitizers thread)
  endif()
  # -Wno-maybe-uninitialized: the code that sanitizers insert causes false warnings of GCC.
  add_compile_options(-fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1
    -Wno-maybe-uninitialized)
  # AddressSanitizer itself ends a program that uses a null pointer or reads beyond the end of an object. Without
  # UBSan's checks of these, and of each virtual call, compilation takes a seventh less time; without its check of
  # alignment, another third less. skein_check_alignment() switches the latter on for code that reads foreign bytes.
  if(SKEIN_SANITIZE STREQUAL address)
    add_compile_options(-fno-sanitize=null,object-size,vptr,alignment)
  endif()
  # Without the options after the first, each program has 110 MB; with them, less than half of that.
  add_link_options(-fsanitize=${sanitizers} -no-pie -Wl,--compress-debug-sections=zlib)
  # Sanitizers do not notice when an empty std::optional is read, or a vector beyond its size and within its capacity.
  add_compile_definitions(_GLIBCXX_ASSERTIONS=1)
  # Debian's libpcl frees memory with plain free() that Eigen allocates here. This definition makes Eigen use malloc().
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# Function names and line numbers for debuggers and backtraces. Paths are relative to the source tree, so that ccache
# hits and symbols stay valid wherever the tree is (docs/decisions/0018-debugging.md).
if(NOT SKEIN_SANITIZE)
  add_compile_options($<$<CONFIG:Release>:-g1>)
  add_link_options($<$<CONFIG:Release>:-Wl,--compress-debug-sections=zlib>)  # sections have a third of their size
  # gold is in the same package as the default linker, and takes half of its time.
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold SKEIN_HAS_GOLD)
  if(SKEIN_HAS_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()
add_compile_options(-ffile-prefix-map=${CMAKE_SOURCE_DIR}=.)

# skein_add_library(NAME [OBJECT] SOURCES ... PUBLIC libs... PRIVATE libs...)
# Headers are included from the repository root: #include "core/types.hpp".
function(skein_add_library name)
  cmake_parse_arguments(ARG "OBJECT" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(ARG_OBJECT)
    add_library(${name} OBJECT ${ARG_SOURCES})
  else()
    add_library(${name} STATIC ${ARG_SOURCES})
  endif()
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/skein>)
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  skein_compile_by_folder(${name} ${ARG_SOURCES})
endfunction()

# The name of the folder whose files are compiled together with this source of the current folder. The sub-folders of
# core/ and of process/ are small, so each of these two counts as one folder.
function(skein_unit_of source out)
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR}/${source} DIRECTORY)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
  string(REGEX REPLACE "^(core|process)/.+" "\\1" folder ${folder})
  string(REPLACE "/" "_" folder ${folder})
  set(${out} ${folder} PARENT_SCOPE)
endfunction()

# skein_compile_by_folder(TARGET SOURCES...)
# Compiles the files of a folder as one, because most of the time is spent on headers. So a name in an unnamed namespace
# must be unique within its folder. CMake compiles a file alone if it has options of its own.
function(skein_compile_by_folder target)
  foreach(source ${ARGN})
    skein_unit_of(${source} group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SKEIN_UNITY} UNITY_BUILD_MODE GROUP)
  # GCC treats the included source files as headers, in which an unnamed namespace would be a mistake.
  target_compile_options(${target} PRIVATE
    $<$<AND:$<BOOL:${SKEIN_UNITY}>,$<COMPILE_LANGUAGE:CXX>>:-Wno-subobject-linkage>)
endfunction()

# skein_compile_quickly(TARGET)
# Optimises less, for code that does no work in the steps of a run: compilation takes two thirds of the time, and
# results are the same.
function(skein_compile_quickly target)
  target_compile_options(${target} PRIVATE $<IF:$<BOOL:${SKEIN_SANITIZE}>,-O0,-O1>)
endfunction()

# skein_link_without_debug_information(TARGET)
# For programs that only tests start, and that no debugger looks into: linking takes less time.
function(skein_link_without_debug_information target)
  target_link_options(${target} PRIVATE $<$<CONFIG:Release>:-Wl,--strip-debug,--compress-debug-sections=none>)
endfunction()

# skein_check_alignment(TARGET)
# For code that parses bytes of messages and files: AddressSanitizer builds also check the alignment of pointers.
function(skein_check_alignment target)
  if(SKEIN_SANITIZE STREQUAL address)
    target_compile_options(${target} PRIVATE -fsanitize=alignment)
  endif()
endfunction()

# skein_add_program(NAME SOURCES ... LIBS ...)
function(skein_add_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS})
  skein_compile_by_folder(${name} ${ARG_SOURCES})
endfunction()

# skein_add_helper(NAME SOURCES ... LIBS ...)
# Adds a program that only tests start; helper_program(NAME) of tests/support/places.hpp returns its path.
function(skein_add_helper name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  if(NOT BUILD_TESTING)
    return()
  endif()
  add_executable(${name} EXCLUDE_FROM_ALL ${ARG_SOURCES})  # the tests that start it depend on it
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} skein_test_places)
endfunction()

# skein_add_helper_agent(NAME SOURCES ...)
# Adds an agent program that only tests start, and NAME_fleet (skein_add_agent()).
function(skein_add_helper_agent name)
  skein_add_agent(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(NOT DEBUG IN_LIST ARGN)  # no debugger looks into it
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1> -g0)
    skein_link_without_debug_information(${name})
    skein_link_without_debug_information(${name}_fleet)
  endif()
endfunction()

# skein_add_test(NAME SOURCES ... LIBS ... [LABELS ...] [TIMEOUT s] [SERIAL] [ALONE] [TURNS k]
#   [HALF 0|1] [PROGRAMS target...])
# Adds a CTest entry with the tests of the sources *_test.cpp. All tests of a CMake folder are one program, for example
# `core_tests`, which runs the tests of one entry at a time (tests/support/test_program.hpp). PROGRAMS: programs that
# the tests start. ALONE: the tests are a program of their own, because they change a whole program (operator new).
# External data come from SKEIN_ASSETS and SKEIN_GOLDEN in the environment. TIMEOUT: see skein_set_timeout(). SERIAL: no
# other entry runs at the same time. TURNS: every k-th of the tests runs, a different share at each commit (SKEIN_TURN;
# without it all run). HALF: the entry runs at every second commit only. Entries of half 0 and of half 1 take the same
# time together, so that all commits do.
function(skein_add_test name)
  cmake_parse_arguments(ARG "SERIAL;ALONE" "TIMEOUT;TURNS;HALF" "SOURCES;LIBS;LABELS;PROGRAMS" ${ARGN})
  if(NOT BUILD_TESTING OR (SKEIN_SANITIZE STREQUAL thread AND NOT name IN_LIST SKEIN_THREAD_TESTS))
    return()
  endif()
  skein_folder_program(program)
  if(ARG_ALONE)
    set(program ${name}_alone)
  endif()
  skein_test_program(${program})
  skein_add_test_sources(${program} ${ARG_SOURCES})
  target_link_libraries(${program} PRIVATE ${ARG_LIBS})
  if(ARG_PROGRAMS)
    add_dependencies(${program} ${ARG_PROGRAMS})
  endif()

  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(files ${ARG_SOURCES})
  list(FILTER files INCLUDE REGEX "_test\\.cpp$")
  list(TRANSFORM files PREPEND "--file;${folder}/")
  set(turns ${ARG_TURNS})
  if(name IN_LIST SKEIN_SLOW_TESTS)
    set(turns 3)
  endif()
  set(aligned)
  if(SKEIN_SANITIZE AND name IN_LIST SKEIN_SLOW_SANITIZED_TESTS)
    set(turns 8)
    set(aligned --aligned)
  elseif(SKEIN_SANITIZE AND name IN_LIST SKEIN_SANITIZED_TESTS_IN_THREE)
    set(turns 3)
  endif()
  if(turns)
    set(turns --turns ${turns} ${aligned})
  endif()
  if(DEFINED ARG_HALF)
    list(APPEND turns --half ${ARG_HALF})
  endif()
  add_test(NAME ${name} COMMAND ${program} --entry ${name} ${turns} ${files})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  skein_set_timeout(${name} ${ARG_TIMEOUT})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS};${folder}")
  if(ARG_SERIAL)
    set_tests_properties(${name} PROPERTIES RUN_SERIAL TRUE)
  endif()
endfunction()

# skein_set_timeout(NAME s)
# CTest kills an entry after five times s, the longest time that the entry takes on an idle machine [s]: machines may be
# busy, and sanitizers take time. A test itself detects earlier that it waits in vain (tests/support/eventually.hpp).
function(skein_set_timeout name seconds)
  # In a new clone, CTest knows no times of earlier runs. By COST it starts the longest entries first there, so that
  # none of them runs alone at the end.
  if(seconds GREATER 120)
    set_tests_properties(${name} PROPERTIES COST ${seconds})
  endif()
  math(EXPR seconds "5 * ${seconds}")
  set_tests_properties(${name} PROPERTIES TIMEOUT ${seconds})
endfunction()

# The name of the program with the tests of the current folder: core_tests, bus_lockstep_tests, tests_fleet.
function(skein_folder_program out)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE "/" "_" program ${folder})
  if(NOT folder MATCHES "^tests/")
    string(APPEND program _tests)
  endif()
  set(${out} ${program} PARENT_SCOPE)
endfunction()

# Adds a test program at the first call.
function(skein_test_program program)
  if(TARGET ${program})
    return()
  endif()
  add_executable(${program})
  skein_test_needs(${program})
  set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests
    UNITY_BUILD ${SKEIN_UNITY} UNITY_BUILD_MODE GROUP)
  target_link_libraries(${program} PRIVATE skein_test_main)
  # Tests are optimised less, and have no debug information in a release build, as they are linked without: compilation
  # takes a third less time, and half of the time with sanitizers.
  target_compile_options(${program} PRIVATE $<$<CONFIG:Release>:-O1;-g0> $<$<BOOL:${SKEIN_SANITIZE}>:-O0>
    $<$<BOOL:${SKEIN_UNITY}>:-Wno-subobject-linkage -Wno-shadow>)  # names of another source file are not shadowed
  skein_link_without_debug_information(${program})
endfunction()

# skein_test_needs(TARGET...)
# Targets that the tests of the current folder need. They are built with the target `tests`, and with a target of the
# folder and of each folder above it, for example tests_in_tests_fleet and tests_in_tests. `./skein test tests/fleet`
# builds one of these; test_folders.txt lists them for ./skein.
function(skein_test_needs)
  add_dependencies(tests ${ARGN})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  while(folder)
    string(REPLACE "/" "_" target tests_in_${folder})
    if(NOT TARGET ${target})
      add_custom_target(${target})
      file(APPEND ${SKEIN_TEST_FOLDERS} "${folder}\n")
    endif()
    add_dependencies(${target} ${ARGN})
    get_filename_component(folder "${folder}" DIRECTORY)
  endwhile()
endfunction()
set(SKEIN_TEST_FOLDERS ${CMAKE_BINARY_DIR}/test_folders.txt)
file(WRITE ${SKEIN_TEST_FOLDERS} "")

# Adds sources to a test program; up to 30 are compiled as one, because each unit spends seven seconds on headers. So a
# name in an unnamed namespace must be unique among the tests of a program, too.
function(skein_add_test_sources program)
  get_target_property(present ${program} SOURCES)
  foreach(source ${ARGN})
    if(source IN_LIST present)
      continue()
    endif()
    target_sources(${program} PRIVATE ${source})
    get_property(count GLOBAL PROPERTY skein_test_sources_of_${program})
    if(NOT count)
      set(count 0)
    endif()
    math(EXPR batch "${count} / 30")
    math(EXPR count "${count} + 1")
    set_property(GLOBAL PROPERTY skein_test_sources_of_${program} ${count})
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${program}_${batch})
  endforeach()
endfunction()
