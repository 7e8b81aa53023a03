// The server as a process: the simulation behind DDS, the lock-step clock, the launcher's pipes, the run's files.
// Everything happens on the thread that calls run().
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/patience.hpp"
#include "bus/lockstep/server.hpp"
#include "bus/lockstep/strangers.hpp"
#include "core/fault_plan.hpp"
#include "process/status_lines.hpp"
#include "process/status_pipe.hpp"
#include "sim_server/cpu_clock.hpp"
#include "sim_server/record/fault_timeline.hpp"
#include "sim_server/record/run_files.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/uav_node.hpp"

namespace skein::sim {

struct SimNodeOptions {
  int base_domain = 0;
  std::filesystem::path out;
  std::uint64_t seed = 0;
  std::optional<double> realtime_factor;  ///< nullopt: lock-step, as fast as the machine allows
  std::optional<double> stop_at_s;        ///< end at this simulated time
  double agent_timeout_s = 60.0;          ///< of wall time, for an answer; 0: for ever
  double startup_timeout_s = 60.0;        ///< of wall time, for everybody to join; 0: for ever
  bool expect_gcs_program = false;        ///< a user's program at the ground station takes part
  FaultPlan faults;
};

class SimNode {
 public:
  SimNode(const Scenario& scenario, Scene scene, const SimNodeOptions& options, bus::Bus& bus, StatusPipe& status);
  ~SimNode();

  /// Runs the mission to its end. @returns its summary; all files are written.
  RunSummary run();

  /// From other threads: end at the next step (the launcher's `stop`, a signal).
  void request_stop();
  /// From other threads: a process of the fleet died (the launcher's `lost NAME`).
  void report_lost(const std::string& name);
  /// From other threads: the process is told to end at once.
  void abort();

 private:
  using Clock = std::chrono::steady_clock;
  using What = status::Order::What;
  /// A fault that kills or stops a program.
  struct ProcessFault {
    Fault fault;
    bool acting = false;
    bool kill() const { return std::holds_alternative<Kill>(fault.action); }
  };

  void declare_members();
  bool wait_for_members();
  bus::Patience give_up_awaited(const std::string& why, double limit_s);
  void publish_step();
  void publish_ledger(const std::vector<LedgerEntry>& entries, std::size_t begin);
  bool wait_for_answers();
  bool gives_up_step();
  void pace(Clock::time_point started);
  void finish_step();
  void take_losses();
  void tell_of_strangers(std::uint64_t patience);
  void let_in_members();
  void begin_process_faults();
  void end_process_faults();
  void tell_order(const std::string& member, What order, Tick tick);
  bool is_last_step() const;
  void report_progress(bool now);
  RunStatus end_status() const;

  const Scenario& scenario_;
  const SimNodeOptions options_;
  StatusPipe& status_;
  std::vector<std::string> uav_names_;
  CpuClock clock_;
  Simulation simulation_;
  FaultTimeline fault_timeline_;
  RunDigest digest_;
  RunFiles files_;
  bus::Inbox inbox_;
  std::vector<std::unique_ptr<bus::Participant>> participants_;  ///< world, gcs, UAVs
  bus::LockstepServer server_;
  bus::Strangers strangers_;  ///< who sends commands without being a member
  std::vector<std::unique_ptr<UavNode>> uavs_;
  std::unique_ptr<bus::CountedWriter> ledger_;
  bus::CountedWriter *gcs_boxes_ = nullptr, *gcs_clock_ = nullptr, *gcs_remained_ = nullptr, *gcs_neighbours_ = nullptr;
  std::vector<ProcessFault> process_faults_;
  RunSummary summary_;
  bool stop_requested_ = false, aborted_ = false, last_step_ = false;
  Clock::time_point stop_requested_at_{};
  std::vector<std::string> stalled_;  ///< who had not answered when a stop was requested, nor for some time after
  Clock::time_point last_progress_{};
  Phase last_phase_ = Phase::waiting;  ///< as last told
};

}  // namespace skein::sim
