# Every package that Skein uses; all are from Debian 12. tests/layers checks which folder uses which package.
include(SkeinAgentDependencies)  # packages that agents with planners from outside this tree also link
find_program(FASTDDSGEN fastddsgen REQUIRED)

# Debian has PCL's headers only in libpcl-dev, which depends on 500 more packages. So ./skein only unpacks the headers.
find_path(PCL_INCLUDE_DIR pcl/point_types.h PATH_SUFFIXES pcl-1.13
  PATHS ${PROJECT_SOURCE_DIR}/build/pcl/usr/include)
if(NOT PCL_INCLUDE_DIR)
  message(FATAL_ERROR "PCL's headers are missing: run ./skein once, or install libpcl-dev")
endif()
set(pcl_parts common)
if(BUILD_TESTING)
  skein_find_pcl(io)  # the tests compare Skein's reader of point files with PCL's
  list(APPEND pcl_parts io)
endif()
foreach(part ${pcl_parts})
  target_include_directories(pcl::${part} INTERFACE ${PCL_INCLUDE_DIR})
endforeach()

# For planners in Python: the interpreter as a library. The CMake package of pybind11 would use the first Python in
# PATH, whichever that is.
pkg_check_modules(PYTHON REQUIRED IMPORTED_TARGET python3-embed)
find_path(PYBIND11_INCLUDE_DIR pybind11/pybind11.h REQUIRED)
add_library(pybind11::headers INTERFACE IMPORTED)
target_include_directories(pybind11::headers INTERFACE ${PYBIND11_INCLUDE_DIR})

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  find_package(valijson REQUIRED)
  include(SkeinPython)
endif()
