# Debian packages of the components, for Debian 12: `cpack` in the build folder writes skein, skein-agent and skein-dev;
# skein-dbgsym and skein-agent-dbgsym, the debug symbols of the first two; skein-source, the code that debuggers show;
# and python3-skein.
# dpkg-shlibdeps derives the dependencies of the programs from the programs, so they must be built on Debian 12.
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL agent runtime dev source python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES OFF)  # CPack strips the components with a -dbgsym package; static libraries keep their symbols
set(CPACK_DEBIAN_AGENT_DEBUGINFO_PACKAGE ON)
set(CPACK_DEBIAN_RUNTIME_DEBUGINFO_PACKAGE ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS binutils)  # addr2line, for the names in the backtrace of a crash
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(SKEIN_MAINTAINER "Skein maintainers <maintainers@skein.invalid>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_PACKAGE_CONTACT ${SKEIN_MAINTAINER})
set(CPACK_PACKAGE_VENDOR Skein)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
string(REPLACE "-" "~" SKEIN_DEBIAN_VERSION ${SKEIN_VERSION})  # for dpkg, 0.2.0~dev is before 0.2.0
set(CPACK_DEBIAN_PACKAGE_VERSION ${SKEIN_DEBIAN_VERSION})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(about "Skein simulates a fleet of inspection UAVs: each a process of its own, in a
DDS domain of its own, repeatable to the last bit.")

set(CPACK_DEBIAN_AGENT_PACKAGE_NAME skein-agent)
set(CPACK_DEBIAN_AGENT_PACKAGE_SECTION science)
set(CPACK_DEBIAN_AGENT_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_AGENT_DESCRIPTION "on-board software of a simulated UAV, and Skein's scenarios
${about}
.
This package is the part of the package skein that flies one of the UAVs, for
small container images.")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME skein)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_PROVIDES "skein-agent (= ${SKEIN_DEBIAN_VERSION})")  # it has all its files
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONFLICTS skein-agent)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_REPLACES skein-agent)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "distributed simulator of inspection UAVs
${about}
.
This package contains all programs of a flight: the launcher, the simulation
server, the radio's router, the ground station and the UAVs' on-board software.")

# The packages that ./skein installs for a build, without those that only Skein's own build needs.
set(CPACK_DEBIAN_DEV_PACKAGE_NAME skein-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "skein (= ${SKEIN_DEBIAN_VERSION})" g++ cmake make pkg-config
  libfastrtps-dev libfastcdr-dev cyclonedds-dev libbullet-dev libembree-dev liboctomap-dev libeigen3-dev libassimp-dev
  liblzf-dev libzstd-dev zlib1g-dev libpcl-common1.13 libcli11-dev libspdlog-dev libyaml-cpp-dev
  libpugixml-dev nlohmann-json3-dev libssl-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS libgtest-dev)
set(CPACK_COMPONENT_DEV_DESCRIPTION "headers and libraries for planners of Skein's UAVs
${about}
.
This package is for planners of your own: find_package(skein) in CMake.")

set(CPACK_DEBIAN_SOURCE_PACKAGE_NAME skein-source)
set(CPACK_DEBIAN_SOURCE_PACKAGE_SECTION debug)
set(CPACK_DEBIAN_SOURCE_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_SOURCE_DESCRIPTION "code of Skein, for debuggers
${about}
.
This package contains the source code of Skein that debuggers show with the
symbols of skein-dbgsym or skein-agent-dbgsym. Nothing is built from it.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-skein)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
# The image of an agent with planners in Python has skein-agent, not skein.
string(JOIN ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "skein (= ${SKEIN_DEBIAN_VERSION}) | skein-agent (= ${SKEIN_DEBIAN_VERSION})"
  "python3 (>= 3.11)" "python3 (<< 3.12)" python3-numpy)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "experiments with Skein and planners for it in Python
${about}
.
This package flies fleets from Python, gives what they leave behind as arrays of
NumPy and frames of pandas, and plots it for papers. And it flies planners that
are written in Python, and programs of your own that take part in a fleet.")

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/debian/changelog.in ${CMAKE_BINARY_DIR}/changelog @ONLY)
execute_process(COMMAND gzip -9nf ${CMAKE_BINARY_DIR}/changelog)
foreach(component agent runtime dev source python)
  string(TOUPPER ${component} upper)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES cmake/debian/copyright DESTINATION ${folder} COMPONENT ${component})
  install(FILES ${CMAKE_BINARY_DIR}/changelog.gz DESTINATION ${folder} COMPONENT ${component})
endforeach()
include(CPack)
