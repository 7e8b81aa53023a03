// Checks of a fault file: names exist, times are within the mission, and no two faults affect the same resource at the
// same time.  Pure.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/faults/fault_plan.hpp"

namespace skein {

/// Whether an exchange begins in [at_s, until_s): otherwise the fault never acts. true for a fault that has no end.
bool has_exchange(const Fault& fault, const Scenario& scenario);

/// The resource that a fault holds, as a text. Two faults that hold the same resource at the same time contradict each
/// other. nullopt for a LinkEffect and a ConditionsChange: several may act at once.
std::optional<std::string> held_by(const FaultAction& action);

class FaultChecker {
 public:
  /// @param scenario, errors  must outlive this. @param latest_s  latest permitted time in the file [s]
  FaultChecker(const Scenario& scenario, ConfigErrors& errors, double latest_s);

  /// Checks a fault and adds its errors. @param longest  the fault with the longest duration that a seed or the fault's
  /// condition can give it. @param shortest  the same with the shortest duration
  void check(const Fault& longest, const Fault& shortest, const std::string& path);

 private:
  void check_times(const Fault& longest, const Fault& shortest, const std::string& path);
  /// Adds the error of a fault that ends before an exchange begins.
  void add_never_acts(const Fault& fault, const std::string& path);
  void check_name(const std::string& name, const std::vector<std::string>& known, const std::string& key,
                  const std::string& what);
  void check_uav(const std::string& name, const std::string& key) { check_name(name, uavs_, key, "UAV"); }
  void check_partition(const Partition& partition, const std::string& key);
  void check_lidar(const LidarFailure& failure, const std::string& key);
  void check_fix(const FixLoss& loss, const std::string& key);
  void check_battery(const BatteryLoss& loss, const std::string& key);
  void check_contradiction(const Fault& fault, const std::string& path);

  const Scenario& scenario_;
  ConfigErrors& errors_;
  const double latest_s_;
  std::vector<std::string> uavs_, nodes_, members_;
  /// The fault that holds a resource, until `end`.
  struct Holder {
    Tick end;
    std::string path;
  };
  /// By resource, then by begin. The intervals of a resource do not overlap, so a new one is compared only with its
  /// neighbours.
  std::map<std::string, std::map<Tick, Holder>> holders_;
};

}  // namespace skein
