// Where a test finds the source tree and what was built of it. Only places.cpp is compiled with these paths: the
// objects of all other tests are the same in every clone, so that ccache shares them.
#pragma once

#include <string>

namespace skein {

/// A file or folder of the source tree, "config/vehicles" say; without an argument its root. Absolute.
std::string source_path(const std::string& below = "");

/// The same below the folder of this build.
std::string build_path(const std::string& below = "");

/// A program that only tests use, one of skein_add_helper().
std::string helper_program(const std::string& name);

/// CMAKE_CXX_COMPILER_LAUNCHER of this build: ccache, or nothing.
std::string compiler_launcher();

/// Debian's Python, which has NumPy and what plots.
std::string python_program();

/// "address" (with undefined behaviour) or "thread"; empty in a build without sanitizers.
std::string sanitizer();

}  // namespace skein
