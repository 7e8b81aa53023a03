# Functions that build agent programs with a user's planners. This build's tests use them, and find_package(skein)
# includes the installed copy.

# skein_add_agent(NAME SOURCES ... [LIBS ...] [DEBUG])
# Adds a program like uav_agent, with all planners of Skein and those that the sources register, and beside it
# NAME_fleet, in which whole fleets of such agents fly in one process. DEBUG compiles the sources for a debugger (-Og);
# the results of a flight stay the same.
function(skein_add_agent name)
  cmake_parse_arguments(ARG "DEBUG" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE skein::agent_main skein::agent skein::agent_nodes ${ARG_LIBS})
  skein_compile_as_skein(${name})
  if(ARG_DEBUG)
    target_compile_options(${name} PRIVATE -Og)  # after the options of the build type, so that it overrides these
  endif()
  add_executable(${name}_fleet $<TARGET_OBJECTS:${name}>)
  target_link_libraries(${name}_fleet PRIVATE
    skein::one_process_main skein::one_process skein::sim_node skein::router_node skein::station_node
    skein::agent skein::agent_nodes ${ARG_LIBS})
  set_target_properties(${name}_fleet PROPERTIES LINKER_LANGUAGE CXX
    RUNTIME_OUTPUT_DIRECTORY $<TARGET_PROPERTY:${name},RUNTIME_OUTPUT_DIRECTORY>
    OUTPUT_NAME $<TARGET_FILE_BASE_NAME:${name}>_fleet)
endfunction()

# skein_add_planner_test(NAME PLANNERS ... SOURCES ... [LIBS ...])
# Adds a GoogleTest program and a CTest entry: the contract of all planners (what each must do and must never do),
# tested on the planners with these names.
function(skein_add_planner_test name)
  cmake_parse_arguments(ARG "" "" "PLANNERS;SOURCES;LIBS" ${ARGN})
  find_package(GTest REQUIRED)
  add_executable(${name} ${ARG_SOURCES}
    ${SKEIN_CONTRACT_DIR}/planner_contract_test.cpp ${SKEIN_CONTRACT_DIR}/test_lidar.cpp
    ${SKEIN_CONTRACT_DIR}/test_world.cpp)
  target_include_directories(${name} PRIVATE ${SKEIN_CONTRACT_DIR}/include)
  target_link_libraries(${name} PRIVATE skein::agent GTest::gtest GTest::gtest_main ${ARG_LIBS})
  skein_compile_as_skein(${name})
  list(TRANSFORM ARG_PLANNERS PREPEND "*/")
  list(JOIN ARG_PLANNERS ":" filter)
  add_test(NAME ${name} COMMAND ${name} --gtest_filter=${filter})
endfunction()

# Compiles a target with Skein's own options: C++20; -O2 unless the user sets a build type; no fused multiply-add, so
# that results do not depend on where the optimiser would use it; full debug symbols.
function(skein_compile_as_skein name)
  target_compile_features(${name} PRIVATE cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${name} PRIVATE -ffp-contract=off -Wno-psabi -g $<$<CONFIG:>:-O2>
    $<$<CXX_COMPILER_ID:GNU>:-gno-inline-points>)  # gdb stops in the planner, not in code that is inlined there
endfunction()
