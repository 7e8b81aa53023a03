# Every package that Skein uses, all from Debian 12. Which folder may use which is checked by tests/layers.
include(SkeinAgentDependencies)  # what an agent needs: planners outside of this tree link it, too
find_program(FASTDDSGEN fastddsgen REQUIRED)

# Double precision Bullet (Debian ships both).
pkg_check_modules(BULLET REQUIRED IMPORTED_TARGET bullet-float64)
find_package(embree 3 REQUIRED)
pkg_check_modules(PCL_IO REQUIRED IMPORTED_TARGET pcl_io)
pkg_check_modules(ASSIMP REQUIRED IMPORTED_TARGET assimp)

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  find_package(valijson REQUIRED)
endif()
