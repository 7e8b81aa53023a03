#include "core/scenario/scenario.hpp"

#include <algorithm>

#include "core/text/suggestion.hpp"

namespace skein {

UavIndex Scenario::uav_index(const std::string& uav_name) const {
  std::vector<std::string> names;
  for (const UavIndex uav : uavs()) {
    if (fleet[uav].name == uav_name) return uav;
    names.push_back(fleet[uav].name);
  }
  throw InputError("scenario '" + name + "' has no UAV '" + uav_name + "'; " + suggestion(uav_name, names));
}

std::vector<std::string> Scenario::uav_names() const {
  std::vector<std::string> names;
  for (const UavConfig& uav : fleet) names.push_back(uav.name);
  return names;
}

const std::string& Scenario::node_name(Node node) const {
  static const std::string station = "gcs";
  return node == kStationNode ? station : fleet.at(*uav_of_node(node)).name;
}

}  // namespace skein
