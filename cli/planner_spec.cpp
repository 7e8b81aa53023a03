#include "cli/planner_spec.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "core/suggestion.hpp"
#include "core/types.hpp"

namespace skein::cli {
std::vector<UavPlanner> parse_planners(const std::string& text, const std::vector<std::string>& fleet) {
  std::map<std::string, std::string> named;
  std::string fallback;
  std::string* last = nullptr;  // the planner that a following parameter belongs to
  std::stringstream items(text);
  for (std::string item; std::getline(items, item, ',');) {
    const std::size_t equals = item.find('=');
    const bool has_key = equals != std::string::npos && equals < item.find(':');
    const std::string key = has_key ? item.substr(0, equals) : "";
    const bool is_uav = has_key && std::find(fleet.begin(), fleet.end(), key) != fleet.end();
    if (has_key && !is_uav && last != nullptr && last->find(':') != std::string::npos) {
      *last += "," + item;
      continue;
    }
    if (has_key && !is_uav) {
      throw InputError("--planner " + text + ": no UAV is called '" + key + "'; " + suggestion(key, fleet));
    }
    const std::string spec = is_uav ? item.substr(equals + 1) : item;
    if (spec.empty())
      throw InputError("--planner " + text + ": a planner's name is missing; write NAME or UAV=NAME,...");
    last = is_uav ? &named[key] : &fallback;
    if (!last->empty()) {
      throw InputError("--planner " + text + ": two planners for " + (is_uav ? "'" + key + "'" : "the same UAVs") +
                       "; give one");
    }
    *last = spec;
  }
  if (text.empty()) throw InputError("--planner: a planner's name is missing; write NAME or UAV=NAME,...");
  if (fallback.empty()) fallback = kDefaultPlanner;

  std::vector<UavPlanner> planners;
  for (const std::string& uav : fleet) {
    const auto found = named.find(uav);
    planners.push_back({uav, found == named.end() ? fallback : found->second});
  }
  return planners;
}

std::string planner_label(const std::string& text) {
  std::string label = text;
  for (char& c : label) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '_') c = '_';
  }
  return label;
}

}  // namespace skein::cli
