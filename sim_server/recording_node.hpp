// The server's part of a run's recording: its samples, the commands that it takes, what happens, the faults, and what
// viewers draw.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "recording/recorder.hpp"
#include "recording/replay.hpp"
#include "sim_server/record/event_log.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class RecordingNode {
 public:
  /// @param events  are recorded as they are logged; must not log after this has gone.
  RecordingNode(const std::filesystem::path& folder, recording::Scope scope, const Scenario& scenario, EventLog& events,
                const recording::ReplayOptions& replay);

  bus::Tap* tap() { return replay_ ? static_cast<bus::Tap*>(&*replay_) : &recorder_; }
  /// Before the samples of a step. @param faults  what begins and ends with it (FaultTimeline).
  void begin_step(const Simulation& simulation, const std::vector<std::string>& faults);
  /// When the members have answered a step: of a run that is flown again, what they said then is taken.
  void end_step();
  /// Whether nothing is left of a run that is flown again.
  bool is_replayed(Tick tick) const;
  /// Where members say something else than then, a sentence each; nullopt: nothing is flown again.
  std::optional<std::vector<std::string>> differences() const;
  /// @returns what went wrong, for people; empty: nothing.
  std::string close();

 private:
  /// As VizNode shows it, less often.
  void add_views(const Simulation& simulation);

  const Scenario& scenario_;
  recording::Recorder recorder_;
  std::optional<recording::Replay> replay_;
  Tick frames_due_ = 0, markers_due_ = 0;
};

}  // namespace skein::sim
