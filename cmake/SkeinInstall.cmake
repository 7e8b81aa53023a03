# What `cmake --install` lays down: the programs, their configuration, and what planners outside of this tree need
# (docs/how-to-add-a-planner.md). find_package(skein) works on the build folder, too.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
set(SKEIN_CONTRACT_DIR ${PROJECT_SOURCE_DIR}/uav_agent/testing)  # where the sources of skein_add_planner_test() are
set(installed_contract_dir ${CMAKE_INSTALL_DATADIR}/skein/contract)

install(TARGETS skein sim_server comm_router station uav_agent uav_agent_fleet skein_doctor RUNTIME)
install(DIRECTORY config/ DESTINATION ${CMAKE_INSTALL_DATADIR}/skein/config)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(libraries core process idl bus lockstep agent agent_nodes agent_main
  sim sim_node router router_node station station_node one_process one_process_main)
foreach(library ${libraries})
  set_target_properties(skein_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS skein_${library} EXPORT skeinTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/skein OBJECTS DESTINATION ${CMAKE_INSTALL_LIBDIR}/skein)
  add_library(skein::${library} ALIAS skein_${library})
endforeach()

# Headers of what a planner may use, where SkeinBuild.cmake has them, and under their former names. The rest is
# internal: the contract's sources get the agent's headers for themselves.
install(DIRECTORY core DESTINATION include/skein FILES_MATCHING PATTERN "*.hpp")
foreach(folder api maps flight planning)
  install(DIRECTORY uav_agent/${folder} DESTINATION include/skein/uav_agent FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(DIRECTORY ${SKEIN_FORWARD_DIR}/ DESTINATION include/skein)
install(FILES uav_agent/testing/planner_contract_test.cpp uav_agent/testing/test_world.cpp
  DESTINATION ${installed_contract_dir})
foreach(folder onboard testing)
  install(DIRECTORY uav_agent/${folder} DESTINATION ${installed_contract_dir}/include/uav_agent
    FILES_MATCHING PATTERN "*.hpp")
endforeach()

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
