#include "core/config_writer.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

namespace skein {

ConfigNode ConfigWriter::number(double value) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return ConfigNode::make_scalar(std::string(digits.data(), result.ptr));
}

ConfigNode ConfigWriter::text(const std::string& value) {
  const bool starts_as_word = !value.empty() && (std::isalpha(static_cast<unsigned char>(value[0])) || value[0] == '/');
  return ConfigNode::make_scalar(value, !starts_as_word || value == "true" || value == "false");
}

}  // namespace skein
