// A function type for loops with independent iterations: it runs them one after another, or in parallel on several
// threads (process/host/workers.hpp). The result must be the same in both cases, so each iteration writes only to
// memory of its own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace skein {

/// Calls work(0) ... work(count - 1), each once, in any order, and returns when all calls have returned.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

inline void one_after_another(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

/// The results of make(item) for all items, in the order of the items.
template <class T, class Item, class Make>
std::vector<T> all_of(const ForEach& for_each, const std::vector<Item>& items, Make make) {
  std::vector<T> made(items.size());
  for_each(items.size(), [&](std::size_t i) { made[i] = make(items[i]); });
  return made;
}

/// Calls work(0) ... work(count - 1) in blocks of `at_once` calls; `for_each` runs the blocks.
void in_blocks(const ForEach& for_each, std::size_t count, std::size_t at_once, auto work) {
  for_each((count + at_once - 1) / at_once, [&](std::size_t block) {
    for (std::size_t i = block * at_once; i < std::min(count, (block + 1) * at_once); ++i) work(i);
  });
}

}  // namespace skein
