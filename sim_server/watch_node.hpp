// The server's side of a run that is watched (--watch): it tells the station what a page needs, and holds the run where
// the page says so. It is there only then; nobody in the fleet hears of it, and it is in no count.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "sim_server/cpu_rate.hpp"
#include "sim_server/estimate_task.hpp"
#include "sim_server/fault_node.hpp"
#include "sim_server/hand_node.hpp"
#include "sim_server/look_node.hpp"
#include "sim_server/pace.hpp"
#include "sim_server/record/event_log.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/wait_teller.hpp"
#include "view/order.hpp"
#include "view/story.hpp"

namespace skein::sim {

struct WatchOptions {
  std::optional<double> speed;            ///< simulated seconds a second; none: as fast as the machine allows
  bool paced = true;                      ///< false: a clock of the world sets the pace, and nothing holds the run
  bool losses = false;                    ///< ask the oracle what could be had, so that the page tells what is lost
  std::optional<double> pause_at_s = {};  ///< the first boundary from this time on pauses the run; none: no such one
};

class WatchNode {
 public:
  /// @param world, uavs  of the server, by UAV; they and the references must outlive this. @param hand  takes what the
  /// page says of UAVs that somebody flies.
  WatchNode(const Scenario& scenario, const Simulation& simulation, EventLog& events, bus::Inbox& inbox,
            bus::Participant& world, std::span<const std::unique_ptr<bus::Participant>> uavs,
            const WatchOptions& options, FaultNode& faults, HandNode& hand);

  /// In each step, when it is published. @param faults  that begin or end with it, in words
  void begin_step(const std::vector<std::string>& faults);
  /// What a UAV says of itself. @param news  it does something else.
  void add_activity(UavIndex uav, const Activity& activity, bool news);
  /// While no step goes on, again and again: for whom, until the next step.
  /// @param what  is awaited of them: "to answer"
  void wait_for(const std::vector<AwaitedMember>& awaited, const std::string& what);
  /// Whether the next scan of this UAV is to be shown, if there is one.
  bool wants_scan(UavIndex uav) const { return look_.wants_scan(uav, Clock::now()); }
  /// At a boundary: does what browsers have asked of faults since. @returns whether any of it was done: who may come
  /// back then is to be let back.
  bool obey_fault_orders();
  /// At a boundary: whether the next exchange may begin. Without a station nobody could end a pause: then it may.
  bool may_go_on();
  /// While it may not: for how long there is nothing to do unless something arrives.
  std::chrono::milliseconds left() const;
  /// For how long the run was held in all [s]: no time of its own.
  double held_s() const { return pace_.held_s(); }

 private:
  using Clock = Pace::Clock;

  void obey(const view::Order& order);
  void tell(const std::string& line);
  void tell_scene();
  void tell_estimate();
  void tell_state(Clock::time_point now);
  void end_wait(Clock::time_point now);
  std::string waits_json() const;
  std::string activities_json() const;
  std::string faults_json() const;
  std::vector<view::ShownUav> shown_uavs() const;
  std::vector<view::ShownLink> shown_links() const;

  const Scenario& scenario_;
  const Simulation& simulation_;
  const WatchOptions options_;
  HandNode& hand_;
  Pace pace_;
  LookNode look_;
  std::unique_ptr<bus::Writer> story_, state_;
  std::unique_ptr<bus::Reader> orders_;
  FaultNode& faults_;
  std::vector<view::FaultOrder> fault_orders_;  ///< since the last boundary
  std::uint64_t done_ = 0, refused_ = 0;        ///< of those so far
  std::string refusal_;                         ///< why the last of them was
  bool station_there_ = true;
  std::vector<view::ShownLink> told_links_;
  struct Saying {
    Activity activity;
    CpuRate cpu;
  };
  std::vector<std::optional<Saying>> sayings_;  ///< by UAV
  std::vector<std::string> awaited_;            ///< names
  std::string awaited_what_;
  Tick pose_due_ = 0, links_due_ = 0;
  bool state_stale_ = true;
  Clock::time_point state_told_{};
  std::optional<EstimateTask> estimate_;  ///< none: nobody asked, or it has been told
};

}  // namespace skein::sim
