// Characters of texts in UTF-8.   Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace skein {

/// The code point at `at` in a UTF-8 text; moves `at` behind it. -1: this is no valid character.
std::int64_t next_character(const std::string& text, std::size_t& at);

bool is_utf8(const std::string& text);

/// Replaces each byte that is no part of a valid character by '?'.
std::string as_utf8(std::string text);

}  // namespace skein
