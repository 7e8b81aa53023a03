// `skein doctor`: finds what prevents a fleet from running on this machine, and how to fix it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bus/reach.hpp"
#include "core/config/network_config.hpp"
#include "core/scenario/scenario.hpp"
#include "doctor/finding.hpp"
#include "doctor/network_facts.hpp"

namespace skein::doctor {

/// The fleet for which the machine is checked.
struct Visit {
  std::size_t uavs = 0;
  std::vector<std::string> domains{};  ///< names, in the order of the domains' numbers
  NetworkConfig network{};
  std::optional<int> base{};  ///< --domain; nullopt: the launcher chooses
  std::filesystem::path results = "runs";
};

/// Runs all checks. Does not retry the look-up of a peer's name. A fault of the machine becomes a finding, not an
/// exception.
Findings examine(const Visit& visit);

/// What is known of the peers of these names. @param addresses  result of bus::look_up_all() for them.
std::vector<PeerFacts> peers_of(const std::vector<std::string>& names, const bus::Addresses& addresses);

}  // namespace skein::doctor
