// The server's output files: trajectories.csv, tracking.csv, digests.csv, events.csv, activity.csv, scene.json and
// sim_server.report.json, from which the launcher makes the server's part of result.json. Times in seconds of simulated
// time, lengths in metres.   Threads: one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/run/work_time.hpp"
#include "core/scenario/scenario.hpp"
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

/// Results of a run that the simulation itself does not know.
struct RunSummary {
  RunStatus status = RunStatus::completed;
  bool deterministic = true;
  std::optional<std::string> digest;
  double wall_time_s = 0.0;  ///< without start-up
  std::vector<Collision> collisions;
  std::vector<LostProcess> lost;
  std::vector<std::string> warnings;
  std::vector<std::uint64_t> commands_unheard;  ///< by UAV: commands from outside the lock-step
  std::uint64_t malformed = 0;                  ///< received samples that could not be decoded as their topic's type
  std::uint64_t unsent = 0;                     ///< samples that could not be sent
  TimingReport timing;
  std::vector<FaultReport> faults;
  std::optional<std::vector<HandReport>> hand;          ///< nullopt: no UAV was flown by hand
  std::vector<WorkTrack> work;                          ///< by UAV
  std::optional<std::vector<std::string>> differences;  ///< from the recorded run; nullopt: no run is flown again
};

/// "ground", "structure" or the name of a UAV.
std::string collided_with(const Collision& collision, const Scenario& scenario);
/// A line for the log: the UAV, what it collided with, time and place.
std::string describe(const Collision& collision, const Scenario& scenario);
/// A line for the log: the UAV, time and place.
std::string describe(const Stray& stray, const Scenario& scenario);

class RunFiles {
 public:
  /// @throws std::runtime_error if the folder cannot be written. If the disk becomes full later, files end early, but
  /// the run goes on; the report names these files.
  RunFiles(const std::filesystem::path& folder, const Scenario& scenario, const RunDigest& digest,
           FlightReport flight = {});

  void write_scene(const Scene& scene);
  EventLog& events() { return events_; }
  ActivityLog& activities() { return activities_; }
  /// Records one exchange: a line in digests.csv, every 100 ms a line per UAV in trajectories.csv, the flight check.
  void add_step(const Simulation& simulation, const StepDigest& digest);
  /// Notes another file that could not be written. @param trouble  a sentence; empty: nothing to note.
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
  std::vector<std::string> unwritten_;  ///< a sentence for each file that could not be written completely
};

}  // namespace skein::sim
