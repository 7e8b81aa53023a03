#include "core/text/number_checks.hpp"

#include "core/text/text.hpp"
#include "core/text/whole_number.hpp"

namespace skein {

std::string check_positive(const std::string& text) {
  const auto number = parse_number(text);
  return number && *number > 0.0 ? "" : "'" + text + "' must be a number above 0";
}

std::string check_not_negative(const std::string& text) {
  const auto number = parse_number(text);
  return number && *number >= 0.0 ? "" : "'" + text + "' must be a number of at least 0";
}

std::string check_timeout_or_none(const std::string& text) { return number_within(0.0, kLongestTimeoutS)(text); }

std::string check_decimal(const std::string& text) {
  const std::size_t first = text.find_first_not_of("+-");
  if (first == std::string::npos || text[first] != '0' || first + 1 == text.size()) return "";
  return "'" + text + "' must be a whole number in decimal digits, without a zero before it";
}

std::string check_seed(const std::string& text) {
  if (!parse_whole(text)) return "'" + text + "' must be a whole number within [0, 18446744073709551615]";
  return check_decimal(text);
}

std::function<std::string(const std::string&)> number_within(double least, double most) {
  return [least, most](const std::string& text) -> std::string {
    const auto number = parse_number(text);
    if (number && *number >= least && *number <= most) return "";
    return "'" + text + "' must be a number within [" + number_text(least) + ", " + number_text(most) + "]";
  };
}

}  // namespace skein
