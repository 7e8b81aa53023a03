// The flight check of a run: what it is shown of the simulation, and what the report says of it. Threads: one.
#pragma once

#include <string>
#include <vector>

#include "core/scenario.hpp"
#include "process/reports/reports.hpp"
#include "sim_server/flight_check/flight_check.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

/// The fleet as it stands at a step boundary.
std::vector<CheckedUav> checked_uavs(const Simulation& simulation, double exchange_period_s);

class FlightReview {
 public:
  /// @param scenario  must outlive this.
  explicit FlightReview(const Scenario& scenario) : scenario_(scenario), check_(scenario) {}

  /// One exchange; those without a mission under way do not count.
  void add_step(const Simulation& simulation);
  FlightCheckReport report() const;
  std::string tracking_csv() const { return check_.findings().tracking.csv(); }

 private:
  const Scenario& scenario_;
  FlightCheck check_;
};

}  // namespace skein::sim
