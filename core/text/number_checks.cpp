#include "core/text/number_checks.hpp"

#include "core/text/text.hpp"

namespace skein {

std::string check_positive(const std::string& text) {
  const auto number = parse_number(text);
  return number && *number > 0.0 ? "" : "'" + text + "' must be a number above 0";
}

std::string check_not_negative(const std::string& text) {
  const auto number = parse_number(text);
  return number && *number >= 0.0 ? "" : "'" + text + "' must be a number of at least 0";
}

}  // namespace skein
