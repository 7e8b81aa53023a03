// Loads a scenario once for all programs of a process: in a large fleet, reading it costs each agent more time and
// memory than its part of the flight.   Threads: any.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "core/scenario/scenario_reader.hpp"

namespace skein {

class ScenarioShelf {
 public:
  /// @returns what load_scenario() returns, the same object as the last time if the arguments are the same.
  /// @throws InputError as load_scenario() does.
  std::shared_ptr<const Scenario> load(const std::string& name_or_path, const LoadOptions& options) {
    const std::scoped_lock lock(mutex_);
    if (!scenario_ || name_ != name_or_path || options_ != options) {
      scenario_ = std::make_shared<const Scenario>(load_scenario(name_or_path, options));
      name_ = name_or_path;
      options_ = options;
    }
    return scenario_;
  }

 private:
  std::mutex mutex_;
  std::string name_;
  LoadOptions options_;
  std::shared_ptr<const Scenario> scenario_;
};

}  // namespace skein
