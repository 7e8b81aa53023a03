// One lock-step round as a list of messages: who writes what to whom in which DDS domain, as a hovering fleet does it
// twenty times a simulated second. Topics, types, QoS and sizes are those of the product; nothing else of it is here.
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
  std::size_t uav = 0;  ///< of an agent
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

/// In each round the server writes its flows and everybody answers once it has received all that is meant for it.
/// Agents get state, neighbours and the step, and send a trajectory, a gimbal command and `done`; the router gets the
/// links and every `done` and sends `routed`. Left out is what nobody reads and what does not come in every round.
std::vector<Flow> round_flows(std::size_t uavs, int base_domain);

}  // namespace skein::bench
