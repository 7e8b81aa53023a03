#include "core/files/command_file.hpp"

#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "core/text/text.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

bool is_program(const fs::path& file) {
  std::error_code gone;
  return ::access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file, gone);
}

}  // namespace

fs::path command_file(const std::string& command) {
  if (command.find('/') != std::string::npos) return is_program(command) ? fs::path(command) : fs::path();
  const char* path = std::getenv("PATH");
  for (const std::string& folder : split(path == nullptr ? "/usr/bin:/bin" : path, ':')) {
    if (is_program(fs::path(folder) / command)) return fs::path(folder) / command;
  }
  return {};
}

}  // namespace skein
