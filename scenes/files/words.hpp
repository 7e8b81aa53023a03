// The words of a text, for the readers of text files. Pure; any thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
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

/// The first characters of a word in a file, for a message: those that are not printable ASCII become '?'.
inline std::string shown(std::string_view word) {
  constexpr std::size_t kShown = 40;
  std::string text(word.substr(0, kShown));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c >= 0x7f; }, '?');
  return text;
}

}  // namespace skein::sim
