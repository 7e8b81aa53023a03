# Agent programs with planners of one's own. Used by this build's tests and, installed, by find_package(skein).

# skein_add_agent(NAME SOURCES ... [LIBS ...] [DEBUG])
# A program like uav_agent: with all planners of Skein, and those that the sources register. Beside it NAME_fleet, in
# which whole fleets of such agents fly as one process. DEBUG: the sources are compiled for a debugger (-Og), and fly
# the same.
function(skein_add_agent name)
  cmake_parse_arguments(ARG "DEBUG" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE skein::agent_main skein::agent skein::agent_nodes ${ARG_LIBS})
  skein_compile_as_skein(${name})
  if(ARG_DEBUG)
    target_compile_options(${name} PRIVATE -Og)  # behind what the build type says of it
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
# A GoogleTest program and a CTest entry: what every planner must do and must never do, for some planners by name.
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

# As Skein itself is compiled: C++20, optimised unless asked otherwise, and no fused multiply-add, so that a result does
# not depend on the optimiser's mood. With all that a debugger can show of a planner.
function(skein_compile_as_skein name)
  target_compile_features(${name} PRIVATE cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${name} PRIVATE -ffp-contract=off -Wno-psabi -g $<$<CONFIG:>:-O2>
    $<$<CXX_COMPILER_ID:GNU>:-gno-inline-points>)  # gdb stops in the planner, not in what is inlined there
endfunction()
