// Characters of texts in UTF-8.   Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace skein {

/// The code point at `at` in a UTF-8 text; moves `at` behind it.
/// -1: there is no valid character, for example because the text ends within it. Then `at` may not have moved, so do
/// not continue from there. @param at  less than the length of the text
std::int64_t next_character(const std::string& text, std::size_t& at);

/// Whether a byte of a UTF-8 text is not the first one of its character.
inline bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xc0u) == 0x80u; }

/// The first `most` bytes of a UTF-8 text, or up to 3 fewer, so that no character is cut through.
std::string first_bytes(const std::string& text, std::size_t most);

bool is_utf8(const std::string& text);

/// Replaces each byte that is not part of a valid character by '?'.
std::string as_utf8(std::string text);

}  // namespace skein
