// The server's part in flying UAVs by hand. At each boundary the server takes the commands that have changed, publishes
// them to the UAVs' agents, and writes them to hand-<uav>.csv, from which the planner `hand` can repeat the flight.
// Without --by-hand this class does nothing.   Threads: one.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bus/lockstep/server.hpp"
#include "process/files/stream_file.hpp"
#include "process/reports/reports.hpp"
#include "sim_server/hand_desk.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class HandNode {
 public:
  /// @param uavs  UAVs that viewers fly. @param folder  for their files. Scenario and simulation must outlive this.
  HandNode(const Scenario& scenario, const Simulation& simulation, const std::vector<UavIndex>& uavs,
           const std::filesystem::path& folder);

  /// Declares the command topic of a UAV in its domain. Does nothing if this UAV is not flown by hand.
  void declare(UavIndex uav, bus::LockstepServer& server, bus::LockstepServer::DomainIndex domain);
  void take(const view::FlyOrder& order) { desk_.take(order, HandDesk::Clock::now()); }
  /// Call it before the samples of a step are written: takes the commands that hold from this step on.
  void begin_step();
  /// Publishes this UAV's command in its domain if it has changed with the present step, or if its agent is new.
  void publish(UavIndex uav);
  /// Call it when the UAV's agent has joined anew and does not know the command: the next step publishes it again.
  void resend(UavIndex uav);
  /// Takes a debug value that a UAV's planner has published. Only kHeldSignal is used: it tells what holds the UAV
  /// back.
  void hear(UavIndex uav, const std::string& name, double value);
  /// Names of the UAVs that viewers fly.
  std::vector<std::string> names() const;
  /// For the viewers' page, by UAV: commanded velocity and yaw rate, and what holds the UAV back (HeldBack).
  std::string state_json() const;

  bool flies() const { return !flown_.empty(); }
  /// nullopt: no UAV is flown by hand.
  std::optional<std::vector<HandReport>> report() const;
  /// At the end of the run: flushes the files. @returns a sentence for each file that could not be written.
  std::vector<std::string> finish();

 private:
  struct Flown {
    Flown(UavIndex index, const std::filesystem::path& file) : uav(index), rows(file) {}

    UavIndex uav;
    StreamFile rows;
    bus::CountedWriter* writer = nullptr;
    HandCommand command;
    std::uint64_t commands = 0;
    double held = 0.0;  ///< HeldBack, as last reported by its planner
    bool due = false;   ///< `command` is yet to be published
  };
  Flown* find(UavIndex uav);

  const Scenario& scenario_;
  const Simulation& simulation_;
  HandDesk desk_;
  std::vector<std::unique_ptr<Flown>> flown_;
};

}  // namespace skein::sim
