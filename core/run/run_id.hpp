// The number of a run. Messages, journals and reports contain it, so that programs ignore those of another run. It has
// no influence on a result and is in no digest.
#pragma once

#include <cstdint>

namespace skein {

/// Drawn by the launcher; `none` for programs started by hand.
enum class RunId : std::uint64_t { none = 0 };

}  // namespace skein
