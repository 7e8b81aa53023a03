// The words of a text, for the readers of text files. Pure; any thread.
#pragma once

#include <algorithm>
#include <string_view>

namespace skein::sim {

/// Calls `use` with each word. @param space  the characters between words.
void for_each_word(std::string_view text, std::string_view space, const auto& use) {
  for (std::size_t begin = text.find_first_not_of(space); begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(space, begin), text.size());
    use(text.substr(begin, end - begin));
    begin = text.find_first_not_of(space, end);
  }
}

}  // namespace skein::sim
