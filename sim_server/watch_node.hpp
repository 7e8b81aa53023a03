// The server's side of a watched run (--watch): it sends the station the data for the viewers' page, and holds the run
// when the page asks for it. No agent receives its messages, and the lock-step does not count them.
// Frame: W.   Units: SI, radians.   Threads: one; the readers store what arrives from threads of the bus.
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
  std::optional<double> speed;            ///< simulated seconds per second of wall time; none: as fast as possible
  bool paced = true;                      ///< false: --clock realtime sets the pace, and the page cannot hold the run
  bool losses = false;                    ///< ask the oracle for the attainable score, to show what is lost
  std::optional<double> pause_at_s = {};  ///< the first boundary at or after this simulated time pauses the run
};

class WatchNode {
 public:
  /// @param world, uavs  the server's participants in the world domain and, by UAV, in the UAVs' domains. They and the
  /// references must outlive this. @param hand  takes the page's orders for UAVs that viewers fly.
  WatchNode(const Scenario& scenario, const Simulation& simulation, EventLog& events, bus::Inbox& inbox,
            bus::Participant& world, std::span<const std::unique_ptr<bus::Participant>> uavs,
            const WatchOptions& options, FaultNode& faults, HandNode& hand);

  /// Call it in each step, before it is published. @param faults  a line for each fault that begins or ends with it
  void begin_step(const std::vector<std::string>& faults);
  /// Takes the activity that a UAV's program reports. @param news  whether it has changed (ActivityLog::add()).
  void add_activity(UavIndex uav, const Activity& activity, bool news);
  /// Call it often while the server waits for members: the page shows their names until the wait is over.
  /// @param what  the members are to do: "to answer"
  void wait_for(const std::vector<AwaitedMember>& awaited, const std::string& what);
  /// Whether the next scan of this UAV is to be shown, if there is one.
  bool wants_scan(UavIndex uav) const { return look_.wants_scan(uav, Clock::now()); }
  /// At a boundary: obeys the orders about faults that have come from browsers since the last call. @returns whether
  /// any was obeyed; then the caller must call FaultNode::let_back_victims().
  bool obey_fault_orders();
  /// At a boundary: whether the next exchange may begin. While the station is away, a pause does not hold the run,
  /// because no viewer could end it.
  bool may_go_on();
  /// While may_go_on() returns false: time until it is worth asking again, unless something arrives first.
  std::chrono::milliseconds left() const;
  /// Total wall time for which the run was held until now [s]; it does not count as run time.
  double held_s(Pace::Clock::time_point now) const { return pace_.held_s(now); }

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
  std::uint64_t done_ = 0, refused_ = 0;        ///< numbers of orders about faults so far
  std::string refusal_;                         ///< the reason for the last refusal
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
  std::optional<EstimateTask> estimate_;  ///< none: not asked for, or over
};

}  // namespace skein::sim
