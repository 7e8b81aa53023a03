# The packages that an agent program links, and a program with a whole fleet; all are from Debian 12. This build uses
# this file, and find_package(skein) includes the installed copy.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)
find_package(pugixml 1.13 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(Threads REQUIRED)

find_package(fastcdr REQUIRED)
find_package(fastrtps REQUIRED)
find_package(CycloneDDS REQUIRED)

find_package(PkgConfig REQUIRED)
pkg_check_modules(OCTOMAP REQUIRED IMPORTED_TARGET octomap)

# The packages of the simulator. Bullet in double precision (Debian has both variants).
pkg_check_modules(BULLET REQUIRED IMPORTED_TARGET bullet-float64)
pkg_check_modules(ASSIMP REQUIRED IMPORTED_TARGET assimp)
pkg_check_modules(LZF REQUIRED IMPORTED_TARGET liblzf)
find_package(zstd REQUIRED)
find_package(ZLIB REQUIRED)
find_package(embree 3 REQUIRED)

# skein_find_pcl(PART...)
# Adds targets pcl::PART, without headers. PCL's own CMake package and its pkg-config files require VTK, Qt and more;
# for these targets, Debian's libpcl-PART1.13 suffices. Only Skein's own build needs headers (SkeinDependencies.cmake).
function(skein_find_pcl)
  foreach(part ${ARGN})
    find_library(SKEIN_PCL_${part} NAMES pcl_${part} libpcl_${part}.so.1.13 REQUIRED)
    if(NOT TARGET pcl::${part})
      add_library(pcl::${part} UNKNOWN IMPORTED GLOBAL)
      set_target_properties(pcl::${part} PROPERTIES IMPORTED_LOCATION ${SKEIN_PCL_${part}})
    endif()
  endforeach()
endfunction()
skein_find_pcl(common)
