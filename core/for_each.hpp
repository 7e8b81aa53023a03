// How somebody has work done that falls into pieces which do not need each other: one after another, or side by side on
// several threads (process/host/workers.hpp). Whoever asks must get the same from both: each piece writes to its own
// place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace skein {

/// Does work(0) ... work(count - 1), each once, in any order, and returns when all are done.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

inline void one_after_another(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

/// What `make` makes of each item, in their order.
template <class T, class Item, class Make>
std::vector<T> all_of(const ForEach& for_each, const std::vector<Item>& items, Make make) {
  std::vector<T> made(items.size());
  for_each(items.size(), [&](std::size_t i) { made[i] = make(items[i]); });
  return made;
}

/// Does work(0) ... work(count - 1), so many of them in one piece.
template <class Work>
void in_blocks(const ForEach& for_each, std::size_t count, std::size_t at_once, Work work) {
  for_each((count + at_once - 1) / at_once, [&](std::size_t block) {
    for (std::size_t i = block * at_once; i < std::min(count, (block + 1) * at_once); ++i) work(i);
  });
}

}  // namespace skein
