// The remote endpoints that one endpoint has matched, as reported by Fast DDS to the endpoint's listener. Any thread.
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

/// Whether a participant is one of Cyclone DDS: its GUIDs begin with Cyclone's vendor id, 1.16.
inline bool is_cyclone(const GuidPrefix_t& prefix) { return prefix.value[0] == 1 && prefix.value[1] == 16; }

class Matches {
 public:
  /// @param own  GUID prefix of the own participant. Fast DDS also matches endpoints within one participant; these are
  /// ignored.
  explicit Matches(const GuidPrefix_t& own) : own_(own) {}

  void begin(const GUID_t& endpoint) {
    const std::scoped_lock lock(mutex_);
    ended_.erase(endpoint);  // the connection was cut, and the endpoint is back
    add(endpoint);
  }
  void end(const GUID_t& endpoint) {
    const std::scoped_lock lock(mutex_);
    participants_.erase(endpoint);
    ended_.insert(endpoint);
  }
  /// Call this when a sample of an endpoint has arrived. Fast DDS delivers samples and reports matches in different
  /// threads, so the first sample may arrive before the match is reported, and the last one after its end.
  void note_sample(const GUID_t& endpoint) {
    const std::scoped_lock lock(mutex_);
    if (!participants_.contains(endpoint) && !ended_.contains(endpoint)) add(endpoint);
  }

  /// Participants of the matched endpoints, one entry per endpoint.
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
  /// Whether any matched endpoint is one of Cyclone DDS.
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
