// What `skein doctor` finds out about the peers of a network.
#pragma once

#include <string>
#include <vector>

#include "bus/reach.hpp"
#include "doctor/network_facts.hpp"

namespace skein::doctor {

/// The peers of these names. @param addresses  result of bus::look_up_all() for them.
std::vector<PeerFacts> peers_of(const std::vector<std::string>& names, const bus::Addresses& addresses);

}  // namespace skein::doctor
