// What the server leaves behind: trajectories.csv, tracking.csv, digests.csv, events.csv, activity.csv,
// scene.json and sim_server.report.json, from which the launcher makes its part of result.json. Times in seconds of
// simulated time, lengths in metres.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/run/work_time.hpp"
#include "core/scenario.hpp"
#include "process/files/stream_file.hpp"
#include "process/reports/reports.hpp"
#include "process/status/status_pipe.hpp"
#include "sim_server/record/activity_log.hpp"
#include "sim_server/record/event_log.hpp"
#include "sim_server/record/flight_review.hpp"
#include "sim_server/run_digest.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

/// A member that the fleet lost.
struct LostProcess {
  std::string name;
  std::uint64_t step = 0;
  Tick tick = 0;
  std::string reason;
  std::optional<Tick> back = {};  ///< when it took part again
};

/// How a run went, beyond what the simulation itself knows.
struct RunSummary {
  RunStatus status = RunStatus::completed;
  bool deterministic = true;
  std::optional<std::string> digest;
  double wall_time_s = 0.0;  ///< without start-up
  std::vector<Collision> collisions;
  std::vector<LostProcess> lost;
  std::vector<std::string> warnings;
  std::vector<std::uint64_t> commands_unheard;  ///< by UAV: from outside the lock-step
  std::uint64_t malformed = 0;                  ///< samples received that were no message of their topic's type
  std::uint64_t unsent = 0;                     ///< samples that could not be sent
  TimingReport timing;
  std::vector<FaultReport> faults;
  std::optional<std::vector<HandReport>> hand;          ///< only where somebody flew
  std::vector<WorkTrack> work;                          ///< by UAV
  std::optional<std::vector<std::string>> differences;  ///< from a run that is flown again
};

/// "ground", "structure" or the name of a UAV.
std::string collided_with(const Collision& collision, const Scenario& scenario);
/// Who, with what, when and where: a line for the log.
std::string describe(const Collision& collision, const Scenario& scenario);
std::string describe(const Stray& stray, const Scenario& scenario);

class RunFiles {
 public:
  /// @throws std::runtime_error when the folder cannot be written. A disk that is full later on ends files, never the
  /// run; the report names them.
  RunFiles(const std::filesystem::path& folder, const Scenario& scenario, const RunDigest& digest,
           FlightReport flight = {});

  void write_scene(const Scene& scene);
  EventLog& events() { return events_; }
  ActivityLog& activities() { return activities_; }
  /// One exchange: a line of digests.csv, every 100 ms a line per UAV of trajectories.csv, and the flight check.
  void add_step(const Simulation& simulation, const StepDigest& digest);
  /// Another file that the disk refused, a sentence.
  void note_unwritten(std::string trouble);
  void write_report(const Simulation& simulation, const RunSummary& summary, StatusPipe& status);

 private:
  SimServerReport report(const Simulation& simulation, const RunSummary& summary) const;
  std::vector<UavReport> uav_reports(const Simulation& simulation, const RunSummary& summary) const;

  std::filesystem::path folder_;
  const FlightReport flight_;
  const Scenario& scenario_;
  StreamFile trajectories_, digests_;
  EventLog events_;
  ActivityLog activities_;
  FlightReview review_;
  std::vector<std::string> unwritten_;  ///< files that the disk refused as a whole, one sentence each
};

}  // namespace skein::sim
