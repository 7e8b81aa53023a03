// How somebody has work done that falls into pieces which do not need each other: one after another, or side by side on
// several threads (process/workers.hpp). Whoever asks must get the same from both: each piece writes to its own place.
#pragma once

#include <cstddef>
#include <functional>

namespace skein {

/// Does work(0) ... work(count - 1), each once, in any order, and returns when all are done.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

inline void one_after_another(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

}  // namespace skein
