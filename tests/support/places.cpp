#include "tests/support/places.hpp"

namespace skein {
namespace {

std::string joined(const std::string& root, const std::string& below) {
  return below.empty() ? root : root + "/" + below;
}

}  // namespace

std::string source_path(const std::string& below) { return joined(SKEIN_TEST_SOURCE_DIR, below); }

std::string build_path(const std::string& below) { return joined(SKEIN_TEST_BUILD_DIR, below); }

std::string helper_program(const std::string& name) { return build_path("tests/" + name); }

std::string compiler_launcher() { return SKEIN_TEST_COMPILER_LAUNCHER; }

std::string python_program() { return SKEIN_TEST_PYTHON; }

std::string sanitizer() { return SKEIN_TEST_SANITIZER; }

}  // namespace skein
