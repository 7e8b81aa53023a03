// The server as a process: the simulation behind DDS, the lock-step clock, the launcher's pipes, the run's files.
// Units: s.   Threads: one, except where a function says otherwise.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/lockstep_node.hpp"
#include "bus/lockstep/patience.hpp"
#include "bus/lockstep/server.hpp"
#include "bus/lockstep/strangers.hpp"
#include "core/faults/fault_plan.hpp"
#include "process/status/status_lines.hpp"
#include "process/status/status_pipe.hpp"
#include "sim_server/cpu_clock.hpp"
#include "sim_server/fault_node.hpp"
#include "sim_server/frames_node.hpp"
#include "sim_server/gcs_node.hpp"
#include "sim_server/hand_node.hpp"
#include "sim_server/progress_teller.hpp"
#include "sim_server/record/run_files.hpp"
#include "sim_server/recording_node.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/step_gate.hpp"
#include "sim_server/uav_node.hpp"
#include "sim_server/viz_node.hpp"
#include "sim_server/wait_teller.hpp"
#include "sim_server/watch_node.hpp"
#include "sim_server/work/work_log.hpp"

namespace skein::sim {

struct SimNodeOptions {
  int base_domain = 0;
  std::filesystem::path out;
  std::uint64_t seed = 0;
  std::optional<double> realtime_factor;  ///< nullopt: lock-step, as fast as the machine allows
  std::optional<double> stop_at_s;        ///< end at this simulated time
  double agent_timeout_s = 60.0;          ///< wall time to wait for a member's answer; 0: for ever
  double startup_timeout_s = 60.0;        ///< wall time to wait for all members to join; 0: for ever
  FlightReport flight = {};               ///< describes the run in the report
  recording::Scope record = recording::Scope::none;
  recording::ReplayOptions replay = {};
  bool notice_deaths = false;               ///< no launcher calls report_lost(): the server detects dead members
  bool expect_gcs_program = false;          ///< wait for a user's program at the ground station before the start
  std::optional<WatchOptions> watch = {};   ///< set: the run is watched (--watch)
  std::vector<std::string> stand_ins = {};  ///< UAVs whose agent relays messages of programs outside the lock-step
  std::vector<UavIndex> by_hand = {};       ///< UAVs that a viewer flies (--by-hand)
  FaultPlan faults;
  std::shared_ptr<StepGate> gate = nullptr;  ///< lets this process step the fleet; null: the run advances by itself
  ForEach for_each = one_after_another;      ///< executes work of the simulation that can be shared
};

class SimNode final : public bus::LockstepNode {
 public:
  SimNode(const Scenario& scenario, Scene scene, const SimNodeOptions& options, bus::Bus& bus, StatusPipe& status);
  ~SimNode() override;

  void start() override;
  void turn(bool arrived) override;
  std::optional<bus::NodeEnd> end() const override;
  bus::Inbox& inbox() override { return inbox_; }
  Rest rest() override;
  /// Complete once end() has a value. Then all files are written, too.
  const RunSummary& summary() const { return summary_; }

  /// From other threads: end at the next step (the launcher's `stop`, a signal).
  void request_stop();
  /// From other threads: a process of the fleet died (the launcher's `lost NAME`).
  void report_lost(const std::string& name);
  /// From other threads: end at once, in the middle of a step (the process must end).
  void abort();

 private:
  using Clock = std::chrono::steady_clock;

  enum class State { joining, in_step, letting_in, pacing, over };

  void declare_members();
  void wait_for(State state, const char* what, double patience_s);
  bool tell_waiting();
  /// Each does what is possible in one state. @returns false when there is nothing more to do in this turn.
  bool join_members();
  bool take_answers(bool arrived);
  bool let_back();
  bool let_in_members();
  bool keep_pace();
  void begin_step();
  bool end_run(bool joined);
  void give_up_awaited(const std::string& why);
  void publish_step();
  void write_samples(bus::LockstepServer::DomainIndex domain);
  bool gives_up_step();
  Clock::time_point due() const;
  void finish_step();
  void take_losses();
  void take_returns(std::uint64_t step);
  bool has_stand_in(const std::string& uav) const;
  void tell_of_strangers(std::uint64_t patience);
  bool is_last_step() const;
  RunStatus end_status() const;

  const Scenario& scenario_;
  const SimNodeOptions options_;
  StatusPipe& status_;
  std::vector<std::string> uav_names_;
  CpuClock clock_;
  Simulation simulation_;
  RunDigest digest_;
  RunFiles files_;
  RecordingNode recording_;
  bus::Inbox inbox_;
  std::vector<std::unique_ptr<bus::Participant>> participants_;  ///< world, gcs, UAVs
  bus::LockstepServer server_;
  bus::Strangers strangers_;  ///< participants that send commands and are not members
  HeardKeyFrames heard_;
  std::vector<std::unique_ptr<UavNode>> uavs_;
  std::vector<std::unique_ptr<FramesNode>> frames_;  ///< of each UAV
  std::unique_ptr<GcsNode> gcs_;
  std::unique_ptr<VizNode> viz_;
  HandNode hand_;
  std::unique_ptr<WatchNode> watch_;  ///< none: the run is not watched
  FaultNode faults_;
  std::optional<WorkLog> work_;  ///< for the report alone; none where a gate steps the fleet
  ProgressTeller progress_;
  State state_ = State::joining;
  std::optional<WaitTeller> wait_;  ///< reports the members for which this state waits
  double patience_s_ = 0.0;
  bus::Patience patience_{0.0}, until_asked_again_{0.0};
  Clock::time_point started_{};  ///< when the first step began
  double cpu_before_s_ = 0.0;    ///< CPU time of this thread until then
  RunSummary summary_;
  bool stop_requested_ = false, aborted_ = false, last_step_ = false;
  Clock::time_point stop_requested_at_{};
  std::vector<std::string> stalled_;  ///< members that had still not answered some time after a stop was requested
};

}  // namespace skein::sim
