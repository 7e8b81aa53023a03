// Words in a text: letters, digits and '_'.   Pure; any thread.
#pragma once

#include <cctype>
#include <string_view>

namespace skein {

/// Whether a text has this word; "uav10" does not have the word "uav1".
inline bool has_word(std::string_view text, std::string_view word) {
  const auto in_word = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  };
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    if ((at == 0 || !in_word(at - 1)) && !in_word(at + word.size())) return true;
  }
  return false;
}

}  // namespace skein
