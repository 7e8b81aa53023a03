// The server's part of a run's recording: the samples that it writes, the commands that it takes, events, faults, and
// the frames and markers that viewers draw. If a recorded run is flown again, it also replays the members' messages.
// Frame of the views: W.   Threads: one.
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
  /// @param events  recorded as they are logged; nothing may be logged after this is destroyed.
  RecordingNode(const std::filesystem::path& folder, recording::Scope scope, const Scenario& scenario, EventLog& events,
                const recording::ReplayOptions& replay);

  bus::Tap* tap() { return replay_ ? static_cast<bus::Tap*>(&*replay_) : &recorder_; }
  /// Call it before the samples of a step are written. @param faults  the lines of FaultTimeline::enter_step().
  void begin_step(const Simulation& simulation, const std::vector<std::string>& faults);
  /// Call it when the members have answered a step. While a recorded run is flown again, the server now takes their
  /// messages of this step from the recording.
  void end_step();
  /// Whether a recorded run is flown again and its recording has nothing left at this tick.
  bool is_replayed(Tick tick) const;
  /// A sentence for each place where members send other messages than in the recorded run; nullopt: no run is flown
  /// again.
  std::optional<std::vector<std::string>> differences() const;
  /// @returns the error, for people; empty: none.
  std::string close();

 private:
  /// Records the frames and markers that VizNode publishes, less often.
  void add_views(const Simulation& simulation);

  const Scenario& scenario_;
  recording::Recorder recorder_;
  std::optional<recording::Replay> replay_;
  Tick frames_due_ = 0, markers_due_ = 0;
};

}  // namespace skein::sim
