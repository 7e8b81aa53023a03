// What makes sense in a fault file: names that exist, times within the mission, no two faults that hold the same thing
// at once.  Pure.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/faults/fault_plan.hpp"

namespace skein {

/// What a fault takes hold of: two that hold the same thing at once contradict each other. Links hold nothing, since
/// several effects may act on one link.
std::optional<std::string> held_by(const FaultAction& action);

class FaultChecker {
 public:
  /// @param scenario, errors  must outlive this. @param latest_s  beyond which no time may be
  FaultChecker(const Scenario& scenario, ConfigErrors& errors, double latest_s);

  /// Adds errors. @param longest  as long as any seed, or its condition, can make it. @param shortest  and as short
  void check(const Fault& longest, const Fault& shortest, const std::string& path);

 private:
  void check_times(const Fault& longest, const Fault& shortest, const std::string& path);
  void check_name(const std::string& name, const std::vector<std::string>& known, const std::string& key,
                  const std::string& what);
  void check_uav(const std::string& name, const std::string& key) { check_name(name, uavs_, key, "UAV"); }
  void check_link(const LinkEffect& effect, const std::string& key);
  void check_partition(const Partition& partition, const std::string& key);
  void check_lidar(const LidarFailure& failure, const std::string& key);
  void check_contradiction(const Fault& fault, const std::string& path);

  const Scenario& scenario_;
  ConfigErrors& errors_;
  const double latest_s_;
  std::vector<std::string> uavs_, nodes_, members_;
  /// From its begin on.
  struct Holder {
    Tick end;
    std::string path;
  };
  /// By what is held, then by begin. They do not overlap, so that a new one need be compared with its neighbours only.
  std::map<std::string, std::map<Tick, Holder>> holders_;
};

}  // namespace skein
