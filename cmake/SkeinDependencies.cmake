# Every package that Skein uses, all from Debian 12. Which folder may use which is checked by tests/layers.
include(SkeinAgentDependencies)  # what an agent needs: planners outside of this tree link it, too
find_program(FASTDDSGEN fastddsgen REQUIRED)

# Debian has PCL's headers only in libpcl-dev, which wants 500 packages more: ./skein unpacks what it needs of it.
find_path(PCL_INCLUDE_DIR pcl/point_types.h PATH_SUFFIXES pcl-1.13
  PATHS ${PROJECT_SOURCE_DIR}/build/pcl/usr/include)
if(NOT PCL_INCLUDE_DIR)
  message(FATAL_ERROR "PCL's headers are missing: run ./skein once, or install libpcl-dev")
endif()
set(pcl_parts common filters)
if(BUILD_TESTING)
  skein_find_pcl(io)  # what our own reader of point files is held against
  list(APPEND pcl_parts io)
endif()
foreach(part ${pcl_parts})
  target_include_directories(pcl::${part} INTERFACE ${PCL_INCLUDE_DIR})
endforeach()

# For planners in Python: the interpreter as a library. pybind11's own package would look for whichever Python is first
# in PATH.
pkg_check_modules(PYTHON REQUIRED IMPORTED_TARGET python3-embed)
find_path(PYBIND11_INCLUDE_DIR pybind11/pybind11.h REQUIRED)
add_library(pybind11::headers INTERFACE IMPORTED)
target_include_directories(pybind11::headers INTERFACE ${PYBIND11_INCLUDE_DIR})

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  find_package(valijson REQUIRED)
  include(SkeinPython)
endif()
