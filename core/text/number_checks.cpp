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

std::function<std::string(const std::string&)> number_within(double least, double most) {
  return [least, most](const std::string& text) -> std::string {
    const auto number = parse_number(text);
    if (number && *number >= least && *number <= most) return "";
    return "'" + text + "' must be a number within [" + number_text(least) + ", " + number_text(most) + "]";
  };
}

}  // namespace skein
