#include "core/scenario.hpp"

#include <algorithm>

#include "core/suggestion.hpp"

namespace skein {

std::size_t Scenario::uav_index(const std::string& uav_name) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    if (fleet[i].name == uav_name) return i;
    names.push_back(fleet[i].name);
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
  return node == kStationNode ? station : fleet.at(node - 1).name;
}

}  // namespace skein
