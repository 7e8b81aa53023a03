#include "cli/planner_spec.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include "core/suggestion.hpp"
#include "core/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

constexpr std::string_view kExec = "exec:";
constexpr std::string_view kGround = "gcs";
constexpr std::size_t kLongestLabel = 100;

/// Whether what follows a comma may still belong to this planner.
bool goes_on(const std::string& spec, bool item_has_key) {
  return spec.starts_with(kExec) || (item_has_key && spec.find(':') != std::string::npos);
}

void check_spec(const std::string& text, const std::string& spec) {
  if (spec.empty()) {
    throw InputError("--planner " + text + ": a planner's name is missing; write NAME or UAV=NAME,...");
  }
  const auto command = exec_command(spec);
  if (command && command->find_first_not_of(' ') == std::string::npos) {
    throw InputError("--planner " + text + ": a command must follow 'exec:', such as exec:./my_planner");
  }
}

}  // namespace

std::optional<std::string> exec_command(const std::string& spec) {
  if (!spec.starts_with(kExec)) return std::nullopt;
  return spec.substr(kExec.size());
}

Planners parse_planners(const std::string& text, const std::vector<std::string>& fleet) {
  std::vector<std::string> nodes = fleet;
  nodes.emplace_back(kGround);
  std::map<std::string, std::string> named;
  std::string fallback;
  std::string* last = nullptr;  // the planner that a following parameter belongs to
  for (const std::string& item : split(text)) {
    const std::size_t equals = item.find('=');
    const bool has_key = equals != std::string::npos && equals < item.find(':');
    const std::string key = has_key ? item.substr(0, equals) : "";
    const bool is_uav = has_key && std::find(nodes.begin(), nodes.end(), key) != nodes.end();
    if (!is_uav && last != nullptr && goes_on(*last, has_key)) {
      *last += "," + item;
      continue;
    }
    if (has_key && !is_uav) {
      throw InputError("--planner " + text + ": no UAV is called '" + key + "'; " + suggestion(key, nodes));
    }
    const std::string spec = is_uav ? item.substr(equals + 1) : item;
    check_spec(text, spec);
    last = is_uav ? &named[key] : &fallback;
    if (!last->empty()) {
      throw InputError("--planner " + text + ": two planners for " + (is_uav ? "'" + key + "'" : "the same UAVs") +
                       "; give one");
    }
    *last = spec;
  }
  if (fallback.empty()) fallback = kDefaultPlanner;

  Planners planners{{}, std::nullopt, fallback};
  for (const std::string& uav : fleet) {
    const auto found = named.find(uav);
    planners.uavs.push_back({uav, found == named.end() ? fallback : found->second});
  }
  if (const auto found = named.find(std::string(kGround)); found != named.end()) planners.ground = found->second;
  return planners;
}

std::string planner_label(const std::string& text) {
  std::string label = text.substr(0, kLongestLabel);
  for (char& c : label) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '_') c = '_';
  }
  return label;
}

}  // namespace skein::cli
