// Replays a recorded run: the simulator uses the recorded samples of the programs instead of their present ones, and
// compares the two. So a single agent can repeat its decisions without the rest of its fleet, or a fleet can repeat a
// run up to the time at which something changes. Not thread-safe.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/tap.hpp"
#include "core/types.hpp"
#include "recording/difference.hpp"
#include "recording/recorded_run.hpp"

namespace CLI {
class App;
}

namespace skein::recording {

struct ReplayOptions {
  std::filesystem::path file;           ///< --replay: recording.mcap; empty: nothing is replayed
  std::optional<double> until_s;        ///< --replay-until: from this time on, the present samples count
  std::vector<std::string> only;        ///< --replay-only: UAVs whose programs take part, by name; empty: all
  std::vector<std::string> other = {};  ///< --replay-other: UAVs with different software, which are not compared

  bool active() const { return !file.empty(); }
  bool takes_part(const std::string& member) const;
  /// Whether the samples of this UAV are compared with the recorded ones.
  bool compares(const std::string& member) const;
  /// Whether the recorded samples count at this time.
  bool replays(Tick tick) const { return active() && (!until_s || tick < ticks(*until_s)); }
};

void add_replay_options(CLI::App& app, ReplayOptions& options);

/// Keeps the first difference of each node.
class Differences {
 public:
  /// Compares the recorded samples of one step on a topic with the present ones.
  void compare(const std::string& node, const std::string& topic, const std::string& wire_type, Tick tick,
               std::span<const mcap::Bytes> recorded, std::span<const mcap::Bytes> now);
  /// In the order in which they were found.
  const std::vector<Difference>& list() const { return list_; }
  /// The differences as sentences (text_of()).
  std::vector<std::string> texts() const;

 private:
  std::vector<Difference> list_;
};

/// For the server of the lock-step: replaces the samples of its members with the recorded ones.
class Replay final : public bus::Tap {
 public:
  /// @param recorder  receives the samples that count. Must outlive this.
  /// @throws InputError if the file is not a complete, undamaged recording.
  Replay(const ReplayOptions& options, bus::Tap& recorder);

  bus::Ear ear(const std::string& node, const bus::TopicSpec& topic) override { return recorder_.ear(node, topic); }
  bus::OnSample taken(const std::string& node, const bus::TopicSpec& topic, bus::OnSample handler) override;

  /// Call it before the samples of a step are processed.
  void begin_step(Tick tick) { tick_ = tick; }
  /// Call it after they are processed: passes on the recorded samples of this step, and compares them with the present.
  void end_step();
  /// Whether the recorded samples would still count, but the recording has ended.
  bool is_over(Tick tick) const { return options_.replays(tick) && tick >= run_.end(); }
  /// Whether the recorded samples count in this step.
  bool replays() const { return options_.replays(tick_); }
  const Differences& differences() const { return differences_; }

 private:
  struct Taken {
    std::string node, wire_type;
    bus::OnSample handler;
    std::vector<mcap::Bytes> now;  ///< present samples of this step
  };

  const ReplayOptions options_;
  bus::Tap& recorder_;
  const RecordedRun run_;
  std::set<std::string> recorded_;  ///< topics in the recording
  Tick tick_ = 0;
  std::map<std::string, Taken> topics_;  ///< by name of the topic in the recording
  Differences differences_;
};

}  // namespace skein::recording
