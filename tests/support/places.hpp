// Paths of the source tree and of the build, for tests. Only places.cpp is compiled with these paths, so the objects of
// all other tests are the same in every clone, and ccache shares them.
#pragma once

#include <string>

namespace skein {

/// Absolute path of a file or folder of the source tree, "config/vehicles" for example; without an argument, its root.
std::string source_path(const std::string& below = "");

/// Absolute path of a file or folder of this build; without an argument, its root.
std::string build_path(const std::string& below = "");

/// Path of a program that only tests use, built by skein_add_helper().
std::string helper_program(const std::string& name);

/// CMAKE_CXX_COMPILER_LAUNCHER of this build: ccache, or nothing.
std::string compiler_launcher();

/// Debian's Python, which has NumPy and Matplotlib.
std::string python_program();

/// "address" (with undefined behaviour) or "thread"; empty in a build without sanitizers.
std::string sanitizer();

}  // namespace skein
