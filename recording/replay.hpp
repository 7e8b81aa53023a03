// A recorded run, flown again: what programs said then is taken in the place of what they say now, which is compared
// with it. So a single agent can think again what it thought in a fleet that is not there, or a fleet be brought to
// the moment at which something is to change. Not thread-safe.
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
  std::optional<double> until_s;        ///< --replay-until: from then on what programs say counts
  std::vector<std::string> only;        ///< --replay-only: who takes part, by name of the UAV; empty: everybody
  std::vector<std::string> other = {};  ///< --replay-other: who runs other software than then, and so is not compared

  bool active() const { return !file.empty(); }
  bool takes_part(const std::string& member) const;
  /// Whether what this member says is compared with what it said then.
  bool compares(const std::string& member) const;
  /// Whether at this time what was said then counts.
  bool replays(Tick tick) const { return active() && (!until_s || tick < ticks(*until_s)); }
};

void add_replay_options(CLI::App& app, ReplayOptions& options);

/// Keeps the first difference of each node.
class Differences {
 public:
  /// What one step's samples on a topic were, and are.
  void compare(const std::string& node, const std::string& topic, const std::string& wire_type, Tick tick,
               std::span<const mcap::Bytes> recorded, std::span<const mcap::Bytes> now);
  /// In the order in which they were found.
  const std::vector<Difference>& list() const { return list_; }
  /// A sentence each.
  std::vector<std::string> texts() const;

 private:
  std::vector<Difference> list_;
};

/// For the lock-step's server: its members' samples.
class Replay final : public bus::Tap {
 public:
  /// @param recorder  hears what is taken. Must outlive this. @throws InputError when the file cannot be replayed.
  Replay(const ReplayOptions& options, bus::Tap& recorder);

  bus::Ear ear(const std::string& node, const bus::TopicSpec& topic) override { return recorder_.ear(node, topic); }
  bus::OnSample taken(const std::string& node, const bus::TopicSpec& topic, bus::OnSample handler) override;

  /// Before a step's samples are taken.
  void begin_step(Tick tick) { tick_ = tick; }
  /// After they were: takes what was said in this step then.
  void end_step();
  /// Whether what was said then would still count, but nothing more was said.
  bool is_over(Tick tick) const { return options_.replays(tick) && tick >= run_.end(); }
  /// Whether it still goes on.
  bool replays() const { return options_.replays(tick_); }
  const Differences& differences() const { return differences_; }

 private:
  struct Taken {
    std::string node, wire_type;
    bus::OnSample handler;
    std::vector<mcap::Bytes> now;  ///< said in this step
  };

  const ReplayOptions options_;
  bus::Tap& recorder_;
  const RecordedRun run_;
  std::set<std::string> recorded_;  ///< topics that it has
  Tick tick_ = 0;
  std::map<std::string, Taken> topics_;  ///< by name in the recording
  Differences differences_;
};

}  // namespace skein::recording
