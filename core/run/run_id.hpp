// The number of a run. Programs of one run know each other by it, and what they leave behind (messages, journals,
// reports) says whose it is, so that no run takes up what another has left. It decides nothing and is in no digest.
#pragma once

#include <cstdint>

namespace skein {

/// Drawn by the launcher; `none` for programs started by hand.
enum class RunId : std::uint64_t { none = 0 };

}  // namespace skein
