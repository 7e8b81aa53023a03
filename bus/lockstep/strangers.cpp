#include "bus/lockstep/strangers.hpp"

namespace skein::bus {

namespace {

/// Maximum number of writers that one program remembers: many participants must not exhaust its memory.
constexpr std::size_t kMaxWriters = 256;

/// The ROS name of a DDS topic: "/x" for "rt/x".
std::string ros_name(const std::string& topic) { return topic.starts_with("rt/") ? topic.substr(2) : topic; }

}  // namespace

void Strangers::add(const std::string& node, const std::string& topic, ParticipantId source, std::uint64_t step) {
  Key key{node, topic, source};
  const auto known = writers_.find(key);
  if (known != writers_.end()) {
    ++known->second.samples;
  } else if (writers_.size() < kMaxWriters) {
    writers_.emplace(std::move(key), Writer{step, 1, false});
  } else {
    ++more_[node];
  }
}

std::vector<Strangers::Notice> Strangers::take_notices(std::uint64_t step, std::uint64_t patience,
                                                       const IsStranger& is_stranger) {
  std::vector<Notice> notices;
  for (auto entry = writers_.begin(); entry != writers_.end();) {
    auto& [key, writer] = *entry;
    if (writer.told || step < writer.first_step + patience) {
      ++entry;
    } else if (!is_stranger(key.source)) {
      entry = writers_.erase(entry);
    } else {
      writer.told = true;
      notices.push_back({key.node, key.topic, writer.samples});
      ++entry;
    }
  }
  return notices;
}

std::uint64_t Strangers::unheard(const std::string& node) const {
  const auto more = more_.find(node);
  std::uint64_t sum = more == more_.end() ? 0 : more->second;
  for (const auto& [key, writer] : writers_) {
    if (key.node == node && writer.told) sum += writer.samples;
  }
  return sum;
}

std::string describe(const Strangers::Notice& notice) {
  return notice.node + ": samples on " + ros_name(notice.topic) + " are " + kUnheardReason;
}

}  // namespace skein::bus
