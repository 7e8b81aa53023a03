// A program of the user's in the place of a UAV's software, or at the ground station: it takes part in the lock-step,
// and hands bytes to whoever drives it. Captures are delivered here, so that no user's program can lose one.
// Everything happens on the thread that drives it.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/lockstep/radio_topics.hpp"
#include "core/scenario.hpp"
#include "idl/type_names.hpp"
#include "uav_agent/member_node.hpp"
#include "uav_agent/onboard/uplink.hpp"

namespace skein::agent {

/// A message on its way, by the name of its topic on the wire, with encapsulation header.
struct WireMessage {
  std::string topic;
  std::vector<std::uint8_t> payload;
};

/// What a user's program reads and writes beyond radio and custody; names and types on the wire.
struct UserTopics {
  std::vector<topics::WireTopic> reads;
  std::vector<topics::WireTopic> writes;
};

class UserNode : public MemberNode {
 public:
  /// @param node  of the radio: a UAV's, or the station's. @param domain  of the DDS.
  UserNode(const Scenario& scenario, Node node, int domain, bus::Bus& bus, UserTopics topics);

  // ---- while a step waits for its answer ---------------------------------------------------------------------------

  /// Whether it does: all that belongs to it is here.
  bool has_step() const { return waits_; }
  using MemberNode::step;
  /// What has arrived with this step, once, by topics and then in the order of writing.
  std::vector<WireMessage> take() { return std::exchange(arrived_, {}); }
  /// Whether the station is in sight, and how many captures it has not acknowledged.
  bool station_linked() const { return station_linked_; }
  std::size_t undelivered() const { return uplink_.undelivered(); }
  /// How often it has joined: another time after a fault had stopped it.
  int joins() const { return joins_; }

  enum class Said { sent, undeclared, full, closed };
  /// Sends with this step's answer. `full`: the step's share of the topic's history is used up; `closed`: a radio topic
  /// that is registered, and not open yet. Nothing is sent then.
  Said say(const std::string& topic, std::vector<std::uint8_t> payload);
  /// Sends all of it: the step is over with the next turn.
  void answer() { answered_ = true; }

  // ---- radio topics of a program's own (docs/radio.md), while a step waits; ROS names and types --------------------

  /// @throws InputError when topic or type is malformed
  void open(const std::string& topic, const std::string& type, const std::vector<std::string>& targets);
  void listen(const std::string& topic, const std::string& type);
  bus::RadioTopics::Status sending(const std::string& topic) const { return radio_->sending(topic); }
  bus::RadioTopics::Status listening(const std::string& topic) const { return radio_->listening(topic); }

 protected:
  void declare(bus::LockstepClient& client) override;
  bool may_think() override;

 private:
  struct Opened {
    std::string type;
    std::vector<std::string> targets;
  };

  void work(const bus::LockstepClient::Step&) override {}
  void send(bus::LockstepClient& client) override;
  void read(bus::LockstepClient& client, const topics::WireTopic& topic, bus::LockstepClient::Counterpart counterpart);
  void write(bus::LockstepClient& client, const topics::WireTopic& topic, bus::LockstepClient::Counterpart counterpart);
  void declare_radio(bus::LockstepClient& client);
  void declare_custody(bus::LockstepClient& client);
  void send_custody(bus::LockstepClient& client);
  void see_neighbours(std::span<const std::uint8_t> payload);
  void request_again();
  bool is_uav() const { return node_ != kStationNode; }

  const Scenario& scenario_;
  const Node node_;
  const UserTopics topics_;
  std::unique_ptr<bus::RadioTopics> radio_;
  std::map<std::string, Opened> opened_;         ///< what it asked for, by ROS topic
  std::map<std::string, std::string> listened_;  ///< type by ROS topic
  std::set<std::string> read_;                   ///< topics on the wire
  std::map<std::string, std::size_t> share_;     ///< messages per step of each topic that is written
  std::map<std::string, std::size_t> said_;      ///< in this step
  std::vector<WireMessage> arrived_, to_send_;
  bool waits_ = false, answered_ = false;
  bool fresh_ = true;  ///< it has just joined
  int joins_ = 0;

  Uplink uplink_;
  bool station_linked_ = false;
  std::map<std::uint64_t, msg::CaptureReport> reports_;  ///< that may yet have to be sent, by capture
  std::vector<std::uint64_t> released_;                  ///< captures that the camera may forget
};

}  // namespace skein::agent
