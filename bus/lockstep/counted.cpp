#include "bus/lockstep/counted.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace skein::bus {

msg::TopicCount topic_count(const std::string& topic, ParticipantId source, std::uint64_t count) {
  msg::TopicCount result;
  result.topic(topic);
  result.source(source);
  result.count(count);
  return result;
}

bool contains(const std::vector<ParticipantId>& matched, ParticipantId who) {
  return std::find(matched.begin(), matched.end(), who) != matched.end();
}

CountedWriter::CountedWriter(Participant& participant, TopicSpec topic, Ear ear)
    : topic_(std::move(topic)),
      ear_(std::move(ear)),
      unsent_(participant.unsent()),
      writer_(participant.create_writer(topic_)) {}

bool CountedWriter::write(std::span<const std::uint8_t> payload) {
  if (count_ - step_start_ >= static_cast<std::uint64_t>(topic_.qos.depth)) {
    unsent_.note(topic_.name, fmt::format("a step may have {}", topic_.qos.depth));
    return false;
  }
  writer_->write(payload);
  if (ear_.hear) ear_.hear(payload);
  ++count_;
  return true;
}

void CountedQueues::add_topic(const std::string& topic, Handler handler) {
  topics_[topic].handler = std::move(handler);
}

void CountedQueues::remove_topic(const std::string& topic) {
  topics_.erase(topic);
  std::erase_if(expected_, [&](const Expected& e) { return e.topic == topic; });
}

void CountedQueues::set_base(const std::string& topic, ParticipantId source, std::uint64_t count) {
  const auto it = topics_.find(topic);
  if (it == topics_.end()) return;
  Lane& lane = it->second.lanes[source];
  lane.arrived = lane.released = count;
  lane.waiting.clear();
}

void CountedQueues::arrive(const std::string& topic, Sample&& sample) {
  Lane& lane = topics_.at(topic).lanes[sample.source];
  ++lane.arrived;
  lane.waiting.push_back(std::move(sample));
}

void CountedQueues::expect(const std::vector<Expected>& expected) {
  expected_.clear();
  for (const Expected& e : expected) {
    if (topics_.contains(e.topic)) expected_.push_back(e);
  }
}

bool CountedQueues::complete() const {
  return std::all_of(expected_.begin(), expected_.end(), [&](const Expected& e) {
    const auto& lanes = topics_.at(e.topic).lanes;
    const auto lane = lanes.find(e.source);
    return e.count == 0 || (lane != lanes.end() && lane->second.arrived >= e.count);
  });
}

void CountedQueues::release() {
  for (const Expected& e : expected_) {
    Topic& topic = topics_.at(e.topic);
    Lane& lane = topic.lanes[e.source];
    while (lane.released < e.count && !lane.waiting.empty()) {
      Sample sample = std::move(lane.waiting.front());
      lane.waiting.pop_front();
      ++lane.released;
      topic.handler(std::move(sample));
    }
  }
}

void CountedQueues::discard(ParticipantId source) {
  for (auto& [name, topic] : topics_) topic.lanes.erase(source);
  std::erase_if(expected_, [&](const Expected& e) { return e.source == source; });
}

std::optional<CountedQueues::Surplus> CountedQueues::surplus(ParticipantId source) const {
  for (const auto& [name, topic] : topics_) {
    const auto lane = topic.lanes.find(source);
    if (lane == topic.lanes.end()) continue;
    const auto expected = std::find_if(expected_.begin(), expected_.end(), [&, &topic_name = name](const Expected& e) {
      return e.source == source && e.topic == topic_name;
    });
    const std::uint64_t announced = expected == expected_.end() ? 0 : expected->count;
    if (lane->second.arrived > announced) return Surplus{name, announced, lane->second.arrived};
  }
  return std::nullopt;
}

std::vector<std::string> CountedQueues::missing(std::optional<ParticipantId> source) const {
  std::vector<std::string> result;
  for (const Expected& e : expected_) {
    if (source && e.source != *source) continue;
    const auto& lanes = topics_.at(e.topic).lanes;
    const auto lane = lanes.find(e.source);
    const std::uint64_t arrived = lane == lanes.end() ? 0 : lane->second.arrived;
    if (arrived < e.count) result.push_back(e.topic + " " + std::to_string(arrived) + " of " + std::to_string(e.count));
  }
  return result;
}

}  // namespace skein::bus
