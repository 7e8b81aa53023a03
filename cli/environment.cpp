#include "cli/environment.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "cli/option_checks.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// glibc 2.33 and later name CPU features without the former suffix "_Usable". With these off, libm's selectors fall
/// back to SSE2, which every x86-64 has.
constexpr const char* kBaselineMath = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX,-SSE4_1";

std::map<std::string, std::string> pinned(bool native) {
  std::map<std::string, std::string> pins = {{"LC_ALL", "C"}, {"OMP_NUM_THREADS", "1"}};
  if (!native) {
    const char* users = std::getenv("GLIBC_TUNABLES");
    pins["GLIBC_TUNABLES"] = (users != nullptr && *users != '\0' ? std::string(users) + ":" : "") + kBaselineMath;
  }
  return pins;
}

}  // namespace

std::vector<std::string> environment_with(const std::map<std::string, std::string>& variables) {
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (!variables.contains(std::string(text.substr(0, text.find('='))))) environment.emplace_back(text);
  }
  for (const auto& [name, value] : variables) environment.push_back(name + "=" + value);
  return environment;
}

std::vector<std::string> fleet_environment(bool native, const std::map<std::string, std::string>& more) {
  std::map<std::string, std::string> variables = pinned(native);
  for (const auto& [name, value] : more) variables[name] = value;
  return environment_with(variables);
}

void check_environment() {
  const char* chaos = std::getenv("SKEIN_CHAOS");
  if (chaos != nullptr && !check_seed(chaos).empty()) {
    throw InputError(std::string("SKEIN_CHAOS=") + chaos + ": must be a whole number, or not set");
  }
}

std::string fleet_environment_prefix(bool native) {
  std::string prefix;
  for (const auto& [name, value] : pinned(native)) prefix += name + "=" + value + " ";
  return prefix;
}

}  // namespace skein::cli
