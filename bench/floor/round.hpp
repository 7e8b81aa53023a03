// One lock-step round as a list of messages: writer, readers, topic and DDS domain of each, as in a hovering fleet,
// which has twenty rounds per simulated second. Topics, types, QoS and sizes are those of the product.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bus/bus.hpp"

namespace skein::bench {

enum class Role { server, router, station, agent };

/// A process of the fleet.
struct Seat {
  Role role = Role::server;
  std::size_t uav = 0;  ///< index of an agent's UAV
  bool operator==(const Seat&) const = default;
};

/// All processes of a fleet, the server first.
std::vector<Seat> seats(std::size_t uavs);

/// One message of every round.
struct Flow {
  int domain = 0;
  bus::TopicSpec topic;
  Seat writer;
  std::vector<Seat> readers;
  std::vector<std::uint8_t> payload;  ///< as production encodes it, encapsulation header included

  bool goes_to(const Seat& seat) const;
};

/// In each round, the server writes its flows, and each other process writes its own once it has received all of its
/// messages. Agents receive state, neighbours and the step, and send a trajectory, a gimbal command and `done`. The
/// router receives the links and every `done`, and sends `routed`. Messages without a reader, and messages that are not
/// part of every round, are left out.
std::vector<Flow> round_flows(std::size_t uavs, int base_domain);

}  // namespace skein::bench
