// What all backends do alike, so that it does not show which one is in use.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "bus/bus.hpp"
#include "bus/reach.hpp"

namespace skein::bus {

/// How many participants of one domain find each other on one machine without multicast: each is announced to this
/// many ports.
inline constexpr int kMaxLocalParticipants = 32;
/// The same for each host of a network.
inline constexpr int kMaxPeerParticipants = 10;

/// A sign of life is sent so often: several times in a lease.
inline int announce_period_s(int lease_s) { return std::clamp(lease_s / 4, 1, 2); }

/// FNV-1a, 64 bit (Fowler, Noll and Vo), over a GUID prefix: the name of a participant, whatever the vendor.
/// @param guid_prefix its 12 bytes in the order in which they stand on the wire
inline ParticipantId participant_id(std::span<const std::uint8_t, 12> guid_prefix) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::uint8_t byte : guid_prefix) hash = (hash ^ byte) * 0x100000001b3;
  return hash;
}

/// RTPS carries payloads as multiples of four bytes. Padding them with zeros before they go out makes a payload the
/// same bytes at every reader, over any transport.
inline std::vector<std::uint8_t> padded(std::span<const std::uint8_t> payload) {
  std::vector<std::uint8_t> bytes((payload.size() + 3) / 4 * 4);
  std::copy(payload.begin(), payload.end(), bytes.begin());
  return bytes;
}

/// Whether a participant takes part in the discovery of nodes with default settings on the same host. Not where
/// certificates decide who may take part, nor where all is as the vendor has it.
inline bool meets_default_nodes(const BusConfig& config, const Reach& reach) {
  return reach.host_only && config.security.empty();
}

/// The network of one of its domains, looked for now; takes its time where names are not yet known.
Reach reach_of(const BusConfig& config, int domain);

/// @throws InputError when the domain id is not 0 .. kMaxDomain
void check_domain(int domain);

}  // namespace skein::bus
