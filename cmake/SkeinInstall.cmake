# Rules of `cmake --install`: the programs, their configuration, and everything that planners outside of this tree need
# (docs/how-to-add-a-planner.md). find_package(skein) also finds the build folder.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
set(SKEIN_CONTRACT_DIR ${PROJECT_SOURCE_DIR}/uav_agent/testing)  # sources for skein_add_planner_test()
set(installed_contract_dir ${CMAKE_INSTALL_DATADIR}/skein/contract)

# Components, each of which is a Debian package, too (SkeinPackages.cmake): `runtime` has the programs of a fleet,
# `agent` only the program of one UAV, `dev` headers and libraries for planners outside of this tree, `source` the code
# that debuggers show, `python` the package `skein` for Python.
set(programs skein sim_server comm_router station uav_agent uav_agent_fleet skein_doctor)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/man)
foreach(program ${programs})
  set(manual ${CMAKE_BINARY_DIR}/man/${program}.1.gz)
  add_custom_command(OUTPUT ${manual} DEPENDS ${program} VERBATIM
    COMMAND sh -c "\"$1\" --manual | gzip -9n >\"$2\"" sh $<TARGET_FILE:${program}> ${manual})
  list(APPEND manuals ${manual})
endforeach()
add_custom_target(manuals ALL DEPENDS ${manuals})
add_dependencies(programs manuals)

function(skein_install_programs component)
  install(TARGETS ${ARGN} RUNTIME COMPONENT ${component})
  list(TRANSFORM ARGN REPLACE "(.+)" "${CMAKE_BINARY_DIR}/man/\\1.1.gz" OUTPUT_VARIABLE pages)
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
  install(DIRECTORY config/ DESTINATION ${CMAKE_INSTALL_DATADIR}/skein/config COMPONENT ${component})
endfunction()
skein_install_programs(runtime ${programs})
skein_install_programs(agent uav_agent)
install(TARGETS skein_other_clock LIBRARY DESTINATION lib/skein COMPONENT runtime)  # for skein check-planner

# The scripts that make reports interactive. SkeinWebBundle.cmake builds them, or fails; with SKEIN_WITHOUT_WEB=1 in the
# environment they are optional.
install(CODE "set(SKEIN_ROOT \"${PROJECT_SOURCE_DIR}\")" COMPONENT runtime)
install(SCRIPT cmake/SkeinWebBundle.cmake COMPONENT runtime)
install(FILES ${PROJECT_SOURCE_DIR}/build/web/report.js ${PROJECT_SOURCE_DIR}/build/web/live.js
  DESTINATION ${CMAKE_INSTALL_DATADIR}/skein/web
  COMPONENT runtime OPTIONAL)
install(FILES cli/completion/skein.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME skein COMPONENT runtime)
install(FILES cli/completion/_skein DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT runtime)
install(FILES cli/completion/skein.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
  COMPONENT runtime)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license)  # Debian packages have a copyright file

# The folder in which config/gdb/skein_printers.py looks for sources.
install(DIRECTORY bus cli comm_router core debug doctor host one_process oracle process recording report results
  run scenes sight signals sim_server station uav_agent view DESTINATION src/skein COMPONENT source
  FILES_MATCHING PATTERN "*.cpp" PATTERN "*.hpp" PATTERN testing EXCLUDE)

# The package for Python, in the folder where Debian's Python finds it if the prefix is /usr.
if(TARGET skein_python)  # extension modules for planners and other programs in Python
  install(TARGETS skein_python skein_client LIBRARY DESTINATION lib/skein COMPONENT python)
endif()
install(DIRECTORY python/skein DESTINATION lib/python3/dist-packages COMPONENT python
  FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
install(FILES python/examples/compare.ipynb python/examples/listen.py python/examples/my_uav.py
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/python COMPONENT python)

set(libraries core process results report view idl mcap bag bus lockstep recording agent agent_nodes agent_main
  sight oracle scenes live_signals sim sim_node router router_node station station_node one_process one_process_main)
foreach(library ${libraries})
  set_target_properties(skein_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS skein_${library} EXPORT skeinTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/skein COMPONENT dev
    OBJECTS DESTINATION ${CMAKE_INSTALL_LIBDIR}/skein COMPONENT dev)
  add_library(skein::${library} ALIAS skein_${library})
endforeach()

# The headers that a planner may use. All others are internal; those that the sources of the planners' contract need are
# installed beside these sources.
install(DIRECTORY core DESTINATION include/skein COMPONENT dev FILES_MATCHING PATTERN "*.hpp")
foreach(folder api maps flight flight_core planning)
  install(DIRECTORY uav_agent/${folder} DESTINATION include/skein/uav_agent COMPONENT dev
    FILES_MATCHING PATTERN "*.hpp")
endforeach()
# Packages for ROS 2, as sources: users of ROS 2 build them with colcon (docs/how-to-ros2.md).
install(DIRECTORY ros2 DESTINATION ${CMAKE_INSTALL_DATADIR}/skein COMPONENT dev USE_SOURCE_PERMISSIONS
  PATTERN generate_messages.py EXCLUDE PATTERN __pycache__ EXCLUDE)
# The types of all messages, for programs of one's own that use DDS without ROS 2.
install(DIRECTORY idl DESTINATION ${CMAKE_INSTALL_DATADIR}/skein COMPONENT dev FILES_MATCHING PATTERN "*.idl")
install(FILES uav_agent/testing/planner_contract_test.cpp uav_agent/testing/test_lidar.cpp
  uav_agent/testing/test_world.cpp
  DESTINATION ${installed_contract_dir} COMPONENT dev)
foreach(folder onboard testing)
  install(DIRECTORY uav_agent/${folder} DESTINATION ${installed_contract_dir}/include/uav_agent COMPONENT dev
    FILES_MATCHING PATTERN "*.hpp")
endforeach()

install(EXPORT skeinTargets NAMESPACE skein:: DESTINATION ${package} COMPONENT dev)
export(EXPORT skeinTargets NAMESPACE skein:: FILE ${CMAKE_BINARY_DIR}/skeinTargets.cmake)

write_basic_package_version_file(${CMAKE_BINARY_DIR}/skeinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
foreach(module SkeinAgent SkeinAgentDependencies)
  configure_file(cmake/${module}.cmake ${CMAKE_BINARY_DIR}/${module}.cmake COPYONLY)
  install(FILES cmake/${module}.cmake DESTINATION ${package} COMPONENT dev)
endforeach()
set(contract_dir ${SKEIN_CONTRACT_DIR})
configure_package_config_file(cmake/skeinConfig.cmake.in ${CMAKE_BINARY_DIR}/skeinConfig.cmake
  INSTALL_DESTINATION ${CMAKE_BINARY_DIR} INSTALL_PREFIX ${CMAKE_BINARY_DIR} PATH_VARS contract_dir)
set(contract_dir ${installed_contract_dir})
configure_package_config_file(cmake/skeinConfig.cmake.in ${CMAKE_BINARY_DIR}/installed/skeinConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS contract_dir)
install(FILES ${CMAKE_BINARY_DIR}/installed/skeinConfig.cmake ${CMAKE_BINARY_DIR}/skeinConfigVersion.cmake
  DESTINATION ${package} COMPONENT dev)
