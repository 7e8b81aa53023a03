// UAVs that somebody flies by hand, at the server's end: what is wanted of each goes to its agent at the next boundary,
// and into hand-<uav>.csv, from which the planner `hand` flies it again. Where nobody flies (--by-hand) nothing of it
// happens.   Threads: one.
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
  /// @param uavs  that somebody flies; @param folder  for their files. All references must outlive this.
  HandNode(const Scenario& scenario, const Simulation& simulation, const std::vector<UavIndex>& uavs,
           const std::filesystem::path& folder);

  /// Declares the topic of a UAV in its domain. Nothing happens when nobody flies it.
  void declare(UavIndex uav, bus::LockstepServer& server, bus::LockstepServer::DomainIndex domain);
  void take(const view::FlyOrder& order) { desk_.take(order, HandDesk::Clock::now()); }
  /// Before the samples of a step are written: takes what is wanted from it on.
  void begin_step();
  /// Publishes the samples of the present step in this UAV's domain.
  void publish(UavIndex uav);
  /// The agent is new, and knows nothing of what is wanted of it.
  void resend(UavIndex uav);
  /// What a UAV's planner says of itself: of interest is what holds it back.
  void hear(UavIndex uav, const std::string& name, double value);
  /// Of the UAVs that somebody flies.
  std::vector<std::string> names() const;
  /// For who looks on: by UAV what is wanted of it, and what holds it back (HeldBack).
  std::string state_json() const;

  bool flies() const { return !flown_.empty(); }
  /// nullopt: nobody flies.
  std::optional<std::vector<HandReport>> report() const;
  /// At the end: puts the files out. @returns what the disk refused, a sentence each.
  std::vector<std::string> finish();

 private:
  struct Flown {
    Flown(UavIndex index, const std::filesystem::path& file) : uav(index), rows(file) {}

    UavIndex uav;
    StreamFile rows;
    bus::CountedWriter* writer = nullptr;
    HandCommand command;
    std::uint64_t commands = 0;
    double held = 0.0;  ///< as its planner says
    bool due = false;   ///< to be published
  };
  Flown* find(UavIndex uav);

  const Scenario& scenario_;
  const Simulation& simulation_;
  HandDesk desk_;
  std::vector<std::unique_ptr<Flown>> flown_;
};

}  // namespace skein::sim
