// Installs npm's packages that read MCAP files into a folder of the build, once for all tests.
#pragma once

#include <cstdlib>
#include <string>

#include "tests/support/places.hpp"

namespace skein::test {

inline std::string reader_folder() { return build_path("recording_check"); }

/// Installs the packages, with these scripts beside them. @returns why that fails; empty: they are installed.
inline std::string install_reader(const std::string& scripts) {
  if (std::system("command -v node >/dev/null && command -v npm >/dev/null") != 0) {
    return "node or npm is missing: no independent reader";
  }
  const std::string to = reader_folder(), from = source_path("tests/recording");
  const std::string install = "mkdir -p " + to + " && cd " + to + " && exec 9>.lock && flock 9 && cp " + from +
                              "/package.json " + from + "/package-lock.json " + scripts + " . && " +
                              "if ! cmp -s package-lock.json .installed; then npm ci --no-audit --no-fund >npm.log " +
                              "2>&1 && cp package-lock.json .installed; fi";
  return std::system(install.c_str()) == 0 ? "" : "npm cannot install the reader: see " + to + "/npm.log";
}

}  // namespace skein::test
