#include "core/config/config_writer.hpp"

#include <cctype>

#include "core/text/text.hpp"

namespace skein {

ConfigNode ConfigWriter::number(double value) { return ConfigNode::make_scalar(shortest(value)); }

ConfigNode ConfigWriter::text(const std::string& value) {
  // A text that looks like a number, true or false needs quotes to stay a text. One that begins with a letter or '/'
  // does not look like a number, so it needs them only if it is true or false.
  const bool starts_as_word = !value.empty() && (std::isalpha(static_cast<unsigned char>(value[0])) || value[0] == '/');
  return ConfigNode::make_scalar(value, !starts_as_word || value == "true" || value == "false");
}

}  // namespace skein
