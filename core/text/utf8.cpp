#include "core/text/utf8.hpp"

namespace skein {

std::int64_t next_character(const std::string& text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(at);
  const std::size_t length = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (length == 0 || first > 0xf4) return -1;
  std::int64_t character = length == 1 ? first : first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (!continues_character(static_cast<char>(byte(at + i)))) return -1;
    character = character << 6 | (byte(at + i) & 0x3fu);
  }
  constexpr std::int64_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = character >= 0xd800 && character <= 0xdfff;
  at += length;
  return character < kLeast[length] || character > 0x10ffff || surrogate ? -1 : character;
}

std::string first_bytes(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && most - end < 3 && continues_character(text[end])) --end;
  return text.substr(0, end);
}

bool is_utf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    if (next_character(text, at) < 0) return false;
  }
  return true;
}

std::string as_utf8(std::string text) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t behind = at;
    if (next_character(text, behind) < 0) {
      text[at] = '?';
      behind = at + 1;
    }
    at = behind;
  }
  return text;
}

}  // namespace skein
