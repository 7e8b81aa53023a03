#include "setup.hpp"

#include <cstdlib>
#include <sstream>

namespace skein_ros {
namespace {

std::optional<std::string> variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::set<std::string> words(const std::string& text) {
  std::set<std::string> result;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) result.insert(word);
  return result;
}

}  // namespace

std::optional<Setup> setup_of_environment() {
  const auto uav = variable("SKEIN_UAV");
  if (!uav || uav->empty()) return std::nullopt;
  Setup setup;
  setup.uav = *uav;
  if (const auto run = variable("SKEIN_RUN")) setup.run = std::strtoull(run->c_str(), nullptr, 10);
  setup.explorer = variable("SKEIN_ROLE") != "photographer";
  setup.radio_hears = {"/plan/" + *uav};
  if (const auto names = variable("SKEIN_RADIO_SENDS")) setup.radio_sends = words(*names);
  if (const auto names = variable("SKEIN_RADIO_HEARS")) setup.radio_hears = words(*names);
  if (const auto names = variable("SKEIN_DEBUG_VALUES")) setup.debug_values = words(*names);
  return setup;
}

}  // namespace skein_ros
