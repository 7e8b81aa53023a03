// The networks of a fleet in containers: one for each DDS domain.   Pure; an object belongs to one thread.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "run/fleet_plan.hpp"

namespace skein::cli {

class ComposeNetworks {
 public:
  explicit ComposeNetworks(const FleetPlan& plan);

  /// Names of all networks; that of a UAV's domain is the UAV's name.
  const std::vector<std::string>& names() const { return names_; }
  /// Those that a program joins, in the same order.
  std::vector<std::string> of(const std::string& program) const;
  /// The program's value of --network: its networks, with the host names of all programs in them.
  std::string text_for(const std::string& program) const;
  /// Host name of a program in a network: "uav.jurong".
  static std::string alias(const std::string& program, const std::string& network);

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<std::string>> members_;  ///< programs by network
};

}  // namespace skein::cli
