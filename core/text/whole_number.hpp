// Parses whole numbers, the same in every locale.   Pure.
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>

namespace skein {

/// Parses the whole text as a decimal number of this type. @returns nullopt if it is none or does not fit the type. A
/// "+" and blanks are not accepted, and a "-" only by signed types.
template <std::integral Number = std::uint64_t>
std::optional<Number> parse_whole(std::string_view text) {
  Number value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  return read.ec == std::errc() && read.ptr == end ? std::optional(value) : std::nullopt;
}

}  // namespace skein
