#include "doctor/peers.hpp"

#include "process/host/address_text.hpp"

namespace skein::doctor {

std::vector<PeerFacts> peers_of(const std::vector<std::string>& names, const bus::Addresses& addresses) {
  std::vector<PeerFacts> peers;
  for (const std::string& name : names) {
    PeerFacts& peer = peers.emplace_back(PeerFacts{.name = name});
    const auto address = addresses.find(name);
    if (address == addresses.end()) continue;
    peer.address = address_text(address->second);
    if (const auto source = bus::source_towards(address->second)) peer.source = address_text(*source);
  }
  return peers;
}

}  // namespace skein::doctor
