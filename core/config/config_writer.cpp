#include "core/config/config_writer.hpp"

#include <cctype>

#include "core/text/text.hpp"

namespace skein {

ConfigNode ConfigWriter::number(double value) { return ConfigNode::make_scalar(shortest(value)); }

ConfigNode ConfigWriter::text(const std::string& value) {
  // In quotes, a value stays a text even if it looks like a number, true or false. No number begins with a letter or
  // '/'.
  const bool starts_as_word = !value.empty() && (std::isalpha(static_cast<unsigned char>(value[0])) || value[0] == '/');
  return ConfigNode::make_scalar(value, !starts_as_word || value == "true" || value == "false");
}

}  // namespace skein
