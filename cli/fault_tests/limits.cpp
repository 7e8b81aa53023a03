#include "cli/fault_tests/limits.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace skein::cli {

std::string number_text(double value) {
  std::array<char, 32> buffer;
  const double rounded = std::round(value * 1e6) / 1e6;  // nobody wants to read more
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded);
  return {buffer.data(), end.ptr};
}

std::optional<double> parse_number(const std::string& text) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string Limits::text() const {
  if (at_least && at_most && *at_least == *at_most) return number_text(*at_least);
  if (at_least && at_most) return "from " + number_text(*at_least) + " to " + number_text(*at_most);
  return at_least ? "at least " + number_text(*at_least) : "at most " + number_text(*at_most);
}

}  // namespace skein::cli
