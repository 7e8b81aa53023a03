// Functions and constants that all backends share, so that they behave alike.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "bus/bus.hpp"
#include "bus/reach.hpp"

namespace skein::bus {

/// How many participants of one domain can discover each other on one host without multicast: a participant announces
/// itself to this many ports.
inline constexpr int kMaxLocalParticipants = 32;
/// The same for each peer host of a network.
inline constexpr int kMaxPeerParticipants = 10;

/// Period of a participant's liveliness announcements [s]: several per lease.
inline int announce_period_s(int lease_s) { return std::clamp(lease_s / 4, 1, 2); }

/// Id of a participant, the same for all vendors: FNV-1a, 64 bit (Fowler, Noll and Vo), over its GUID prefix.
/// @param guid_prefix  its 12 bytes, in the order of the wire format
inline ParticipantId participant_id(std::span<const std::uint8_t, 12> guid_prefix) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::uint8_t byte : guid_prefix) hash = (hash ^ byte) * 0x100000001b3;
  return hash;
}

/// Pads a payload with zeros to a multiple of four bytes. RTPS pads payloads to such lengths; zeros that the writer
/// adds make sure that all readers receive the same bytes over any transport.
inline std::vector<std::uint8_t> padded(std::span<const std::uint8_t> payload) {
  std::vector<std::uint8_t> bytes((payload.size() + 3) / 4 * 4);
  std::copy(payload.begin(), payload.end(), bytes.begin());
  return bytes;
}

/// Whether participants are made discoverable for nodes with default settings on the same host. False in a secured
/// fleet, where certificates decide who takes part, and if other hosts take part.
inline bool meets_default_nodes(const BusConfig& config, const Reach& reach) {
  return reach.host_only && config.security.empty();
}

/// Resolves the network of a domain; see find_reach(), also for its exceptions. May block while names are looked up.
Reach reach_of(const BusConfig& config, int domain);

/// @throws InputError when the domain id is not 0 .. kMaxDomain
void check_domain(int domain);

}  // namespace skein::bus
