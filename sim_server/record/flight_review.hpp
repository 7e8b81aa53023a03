// Feeds the flight check of a run from the simulation, and makes its part of the report. Threads: one.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "process/reports/reports.hpp"
#include "sim_server/flight_check/flight_check.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

/// The fleet's state at a step boundary. @param exchange_period_s  [s].
std::vector<CheckedUav> checked_uavs(const Simulation& simulation, double exchange_period_s);

class FlightReview {
 public:
  /// @param scenario  must outlive this.
  explicit FlightReview(const Scenario& scenario) : scenario_(scenario), check_(scenario) {}

  /// Adds one exchange. Exchanges before and after the mission do not count.
  void add_step(const Simulation& simulation);
  FlightCheckReport report() const;
  std::string tracking_csv() const { return check_.findings().tracking.csv(); }

 private:
  const Scenario& scenario_;
  FlightCheck check_;
};

}  // namespace skein::sim
