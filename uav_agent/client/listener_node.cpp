#include "uav_agent/client/listener_node.hpp"

#include <algorithm>

#include "bus/lockstep/names.hpp"

namespace skein::agent {

ListenerNode::ListenerNode(bus::Bus& bus, int domain, const std::vector<topics::WireTopic>& topics, std::size_t most)
    : most_(most), participant_(bus.join(domain)) {
  for (const topics::WireTopic& topic : topics) {
    const auto take = [this, name = topic.name](bus::Sample&& sample) {
      const std::scoped_lock lock(mutex_);
      if (waiting_.size() == most_) {
        waiting_.pop_front();
        ++missed_;
      }
      waiting_.push_back({name, std::move(sample)});
      arrived_.notify_one();
    };
    readers_.push_back(participant_->create_reader(bus::spec(topic), take));
  }
}

ListenerNode::~ListenerNode() = default;

std::optional<ListenerNode::Heard> ListenerNode::next(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_for(lock, timeout, [this] { return !waiting_.empty(); })) return std::nullopt;
  Heard heard = std::move(waiting_.front());
  waiting_.pop_front();
  return heard;
}

bool ListenerNode::has_writers() const {
  return std::ranges::any_of(readers_, [](const auto& reader) { return !reader->matched().empty(); });
}

std::uint64_t ListenerNode::missed() const {
  const std::scoped_lock lock(mutex_);
  return missed_;
}

}  // namespace skein::agent
