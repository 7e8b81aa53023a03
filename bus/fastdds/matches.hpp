// The endpoints that one endpoint has matched, by what Fast DDS tells its listener. Any thread.
#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <vector>

#include "bus/bus.hpp"
#include "bus/wire.hpp"

namespace skein::bus::fastdds {

using eprosima::fastrtps::rtps::GUID_t;
using eprosima::fastrtps::rtps::GuidPrefix_t;

inline ParticipantId id_of(const GuidPrefix_t& prefix) {
  return participant_id(std::span<const std::uint8_t, 12>(prefix.value, 12));
}

/// Cyclone DDS: its GUIDs begin with its vendor id, 1.16.
inline bool is_cyclone(const GuidPrefix_t& prefix) { return prefix.value[0] == 1 && prefix.value[1] == 16; }

class Matches {
 public:
  /// @param own  Fast DDS matches endpoints of one participant, too; these do not count.
  explicit Matches(const GuidPrefix_t& own) : own_(own) {}

  void begin(const GUID_t& endpoint) {
    const std::scoped_lock lock(mutex_);
    ended_.erase(endpoint);  // it was cut off and is back
    add(endpoint);
  }
  void end(const GUID_t& endpoint) {
    const std::scoped_lock lock(mutex_);
    participants_.erase(endpoint);
    ended_.insert(endpoint);
  }
  /// A sample of it is here. Fast DDS hands samples out from one thread and tells of matches from another one, so the
  /// first sample may come before the match, and the last one after its end.
  void note_sample(const GUID_t& endpoint) {
    const std::scoped_lock lock(mutex_);
    if (!participants_.contains(endpoint) && !ended_.contains(endpoint)) add(endpoint);
  }

  /// One entry an endpoint.
  std::vector<ParticipantId> participants() const {
    const std::scoped_lock lock(mutex_);
    std::vector<ParticipantId> ids;
    for (const auto& [endpoint, id] : participants_) ids.push_back(id);
    return ids;
  }
  bool empty() const {
    const std::scoped_lock lock(mutex_);
    return participants_.empty();
  }
  /// Whether Cyclone DDS is among them.
  bool any_cyclone() const {
    const std::scoped_lock lock(mutex_);
    return std::any_of(participants_.begin(), participants_.end(),
                       [](const auto& match) { return is_cyclone(match.first.guidPrefix); });
  }

 private:
  void add(const GUID_t& endpoint) {
    if (endpoint.guidPrefix != own_) participants_.emplace(endpoint, id_of(endpoint.guidPrefix));
  }

  const GuidPrefix_t own_;
  mutable std::mutex mutex_;
  std::map<GUID_t, ParticipantId> participants_;
  std::set<GUID_t> ended_;
};

}  // namespace skein::bus::fastdds
