# What an agent program links, all from Debian 12. Used by this build and, installed, by find_package(skein).
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
# PCL is asked for by module, through pkg-config: its CMake package drags VTK and Qt into every target.
pkg_check_modules(PCL REQUIRED IMPORTED_TARGET pcl_common pcl_filters)
