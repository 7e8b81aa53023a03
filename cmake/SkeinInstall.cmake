# What `cmake --install` lays down: the programs, their configuration, and what planners outside of this tree need
# (docs/how-to-add-a-planner.md). find_package(skein) works on the build folder, too.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
set(SKEIN_CONTRACT_DIR ${PROJECT_SOURCE_DIR}/uav_agent)  # where the sources of skein_add_planner_test() are
set(installed_contract_dir ${CMAKE_INSTALL_DATADIR}/skein/contract)

install(TARGETS skein sim_server comm_router station uav_agent RUNTIME)
install(DIRECTORY config/ DESTINATION ${CMAKE_INSTALL_DATADIR}/skein/config)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(libraries core idl bus lockstep agent agent_main)
foreach(library ${libraries})
  set_target_properties(skein_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS skein_${library} EXPORT skeinTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/skein OBJECTS DESTINATION ${CMAKE_INSTALL_LIBDIR}/skein)
  add_library(skein::${library} ALIAS skein_${library})
endforeach()

# Headers of what a planner may use: not those of the nodes, which alone talk over the bus. Where: as SkeinBuild.cmake has
# it.
install(DIRECTORY core DESTINATION include/skein FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY uav_agent DESTINATION include/skein
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*_node.hpp" EXCLUDE PATTERN "neighbours.hpp" EXCLUDE)
install(FILES uav_agent/planner_contract_test.cpp uav_agent/test_world.cpp DESTINATION ${installed_contract_dir})

install(EXPORT skeinTargets NAMESPACE skein:: DESTINATION ${package})
export(EXPORT skeinTargets NAMESPACE skein:: FILE ${CMAKE_BINARY_DIR}/skeinTargets.cmake)

write_basic_package_version_file(${CMAKE_BINARY_DIR}/skeinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
foreach(module SkeinAgent SkeinAgentDependencies)
  configure_file(cmake/${module}.cmake ${CMAKE_BINARY_DIR}/${module}.cmake COPYONLY)
  install(FILES cmake/${module}.cmake DESTINATION ${package})
endforeach()
set(contract_dir ${SKEIN_CONTRACT_DIR})
configure_package_config_file(cmake/skeinConfig.cmake.in ${CMAKE_BINARY_DIR}/skeinConfig.cmake
  INSTALL_DESTINATION ${CMAKE_BINARY_DIR} INSTALL_PREFIX ${CMAKE_BINARY_DIR} PATH_VARS contract_dir)
set(contract_dir ${installed_contract_dir})
configure_package_config_file(cmake/skeinConfig.cmake.in ${CMAKE_BINARY_DIR}/installed/skeinConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS contract_dir)
install(FILES ${CMAKE_BINARY_DIR}/installed/skeinConfig.cmake ${CMAKE_BINARY_DIR}/skeinConfigVersion.cmake
  DESTINATION ${package})
