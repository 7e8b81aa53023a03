#include "recording/replay.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "core/topics.hpp"
#include "recording/choice.hpp"

namespace skein::recording {
namespace {

/// Whether a topic has text for people only. No result depends on it, and another version may use other words.
bool is_for_people(const std::string& topic) { return topic.ends_with("/activity"); }

/// Whether the server receives this topic from a UAV: commands, notes that the station has a capture, debug values and
/// activities.
bool is_taken(const std::string& topic) {
  return topic.find("/command/") != std::string::npos || topic.ends_with(topics::kCaptureStored.pattern) ||
         topic.find("/debug/") != std::string::npos || is_for_people(topic);
}

}  // namespace

bool ReplayOptions::takes_part(const std::string& member) const {
  return only.empty() || std::ranges::find(only, member) != only.end();
}

bool ReplayOptions::compares(const std::string& member) const {
  return takes_part(member) && std::ranges::find(other, member) == other.end();
}

void add_replay_options(CLI::App& app, ReplayOptions& options) {
  app.add_option("--replay", options.file, "recording.mcap of a run that is flown again")->group("Launcher");
  app.add_option("--replay-until", options.until_s, "From this simulated time on, what programs say counts [s]")
      ->group("Launcher");
  app.add_option("--replay-only", options.only, "UAVs whose programs take part (default: all)")
      ->delimiter(',')
      ->group("Launcher");
  app.add_option("--replay-other", options.other, "UAVs that run other software than then: not compared")
      ->delimiter(',')
      ->group("Launcher");
}

void Differences::compare(const std::string& node, const std::string& topic, const std::string& wire_type, Tick tick,
                          std::span<const mcap::Bytes> recorded, std::span<const mcap::Bytes> now) {
  if (std::ranges::any_of(list_, [&](const Difference& known) { return known.node == node; })) return;
  if (auto found = first_difference(wire_type, recorded, now)) {
    list_.push_back({node, topic, tick, std::move(found->first), std::move(found->second)});
  }
}

std::vector<std::string> Differences::texts() const {
  std::vector<std::string> texts;
  for (const Difference& difference : list_) texts.push_back(text_of(difference));
  return texts;
}

Replay::Replay(const ReplayOptions& options, bus::Tap& recorder)
    : options_(options), recorder_(recorder), run_(options.file, is_taken) {
  run_.each([this](Tick, const Said& said) { recorded_.insert(said.topic); });
}

bus::OnSample Replay::taken(const std::string& node, const bus::TopicSpec& topic, bus::OnSample handler) {
  const std::string name = recorded_topic(node, ros_topic(topic.name));
  topics_[name] = {node, topic.type, recorder_.taken(node, topic, std::move(handler)), {}};
  return [this, name](bus::Sample&& sample) {
    Taken& taken = topics_.at(name);
    const bool lacks = is_for_people(name) && !recorded_.contains(name);  // recording of a version without the topic
    if (!replays() || lacks) return taken.handler(std::move(sample));
    taken.now.push_back(std::move(sample.payload));
  };
}

void Replay::end_step() {
  if (!replays()) return;
  std::map<std::string, std::vector<mcap::Bytes>> recorded;
  for (const Said& said : run_.at(tick_)) {
    const auto found = topics_.find(said.topic);
    if (found == topics_.end()) continue;
    recorded[said.topic].push_back(said.payload);
    found->second.handler({said.payload, 0});
  }
  for (auto& [name, taken] : topics_) {
    if (options_.compares(taken.node) && !is_for_people(name)) {
      differences_.compare(taken.node, name, taken.wire_type, tick_, recorded[name], taken.now);
    }
    taken.now.clear();
  }
}

}  // namespace skein::recording
