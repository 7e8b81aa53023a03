// Radio topics that a member registers while the run lasts (docs/radio.md): to send on "/x", and to hear what others
// send here on "/y". What a request brings is the same in every run, and takes effect in the same step.
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
  /// Before client.start(); it must outlive this. @param node  the asking one: "gcs" or a UAV's name.
  RadioTopics(LockstepClient& client, std::string node);

  /// How a registration stands.
  struct Status {
    bool open = false;                 ///< messages pass
    std::string refusal;               ///< why not, and never will
    std::vector<std::string> unheard;  ///< send(): targets at which nobody listens yet
  };

  /// Asks to send on a topic. While thinking; messages may follow once it is open, at the earliest in the next step.
  /// @param topic "/x" @param type "std_msgs/msg/String" @param targets  nodes, or {"all"}
  /// @throws InputError when topic or type is malformed
  void send(const std::string& topic, const std::string& type, const std::vector<std::string>& targets);
  /// Asks to hear what is sent to this node on a topic. While thinking. It opens as soon as somebody may send.
  /// @param handler  gets each sample, as with LockstepClient::read()
  /// @throws InputError when topic or type is malformed
  void listen(const std::string& topic, const std::string& type, CountedQueues::Handler handler);
  /// First thing in each step: asks again what a router that has come back knows nothing of.
  void begin_step();

  /// Puts a message on the air. While thinking.
  /// @returns false when the topic is not open, or this step's share is sent.
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

  template <class Map>
  static Status status(const Map& map, const std::string& topic) {
    const auto found = map.find(topic);
    return found == map.end() ? Status{} : found->second.status;
  }
  void ask(msg::RadioRequest& request);
  void on_reply(const msg::RadioReply& reply);

  LockstepClient& client_;
  const std::string node_;
  const ParticipantId self_;
  ParticipantId router_ = 0;  ///< whom we have asked
  std::uint32_t last_id_ = 0;
  std::map<std::string, Sending> sendings_;  ///< by ROS topic
  std::map<std::string, Listening> listenings_;
};

}  // namespace skein::bus
