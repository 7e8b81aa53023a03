// Checks of a link effect, in a scenario's `radio.links` or in a fault: names exist, and it changes something.  Pure.
#pragma once

#include <string>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/radio/link_effect.hpp"

namespace skein {

/// The error of a `queue_bytes` without `bandwidth_bit_s`.
inline constexpr const char* kNeedsBandwidth = "needs bandwidth_bit_s: without it no message waits in a queue";

/// Adds an error for each node that does not exist or is named twice, and for an effect that changes no link.
/// @param nodes  the names of all nodes @param key  path of the effect's key
void check_link_effect(const LinkEffect& effect, const std::vector<std::string>& nodes, const std::string& key,
                       ConfigErrors& errors);

}  // namespace skein
