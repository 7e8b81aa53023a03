// Radio topics that a member registers during a run (docs/radio.md): to send on "/x", and to receive what other nodes
// send to this node on "/y". A request has the same outcome in every run, and takes effect in the same step.
// Threads: all calls from the thread that dispatches the inbox.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bus/lockstep/client.hpp"

namespace skein::bus {

class RadioTopics {
 public:
  /// Create it before client.start(); the client must outlive it. @param node  the asking node: "gcs" or a UAV's name.
  RadioTopics(LockstepClient& client, std::string node);

  /// State of a registration.
  struct Status {
    bool open = false;                 ///< messages can pass
    std::string refusal;               ///< the router's reason for a refusal; empty: not refused
    std::vector<std::string> unheard;  ///< for send(): targets at which no program listens yet
  };

  /// Asks to send on a topic. Call it while thinking; write() works once the topic is open, not before the next step.
  /// Until then send() may be called again, also with another type, for example after a refusal.
  /// @param topic "/x" @param type "std_msgs/msg/String" @param targets  nodes, or {"all"}
  /// @throws InputError when topic or type is malformed
  void send(const std::string& topic, const std::string& type, const std::vector<std::string>& targets);
  /// Asks to receive messages to this node on a topic. Call it while thinking. The topic opens as soon as a node may
  /// send on it. Until then listen() may be called again, also with another type, for example after a refusal; later
  /// calls only replace the handler.
  /// @param handler  gets each sample, as with LockstepClient::read()
  /// @throws InputError when topic or type is malformed
  void listen(const std::string& topic, const std::string& type, CountedQueues::Handler handler);
  /// Call this first in each step: repeats all requests, except those that were refused, to a router that has come
  /// back, because it does not know them.
  void begin_step();

  /// Sends a message by radio. Call it while thinking.
  /// @returns false, without sending, when the topic is not open or this step's share is used up.
  bool write(const std::string& topic, std::span<const std::uint8_t> payload);
  Status sending(const std::string& topic) const { return status(sendings_, topic); }
  Status listening(const std::string& topic) const { return status(listenings_, topic); }

 private:
  struct Sending {
    msg::RadioRequest request;
    Status status;
  };
  struct Listening {
    msg::RadioRequest request;
    CountedQueues::Handler handler;
    Status status;
  };

  static Status status(const auto& map, const std::string& topic) {
    const auto found = map.find(topic);
    return found == map.end() ? Status{} : found->second.status;
  }
  void ask(msg::RadioRequest& request);
  void on_reply(const msg::RadioReply& reply);

  LockstepClient& client_;
  const std::string node_;
  const ParticipantId self_;
  ParticipantId router_ = 0;                 ///< the router that has our requests
  std::uint32_t last_id_ = 0;                ///< id of the last request
  std::map<std::string, Sending> sendings_;  ///< by ROS topic
  std::map<std::string, Listening> listenings_;
};

}  // namespace skein::bus
