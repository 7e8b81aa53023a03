#include "cli/option_checks.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

constexpr double kLongestS = 36000.0, kLeastFactor = 0.001, kGreatestFactor = 1000.0;
constexpr double kLeastMapsPeriodS = 1.0, kGreatestMapsPeriodS = 3600.0;

}  // namespace

std::string check_clock(const std::string& text) {
  if (text == "lockstep" || text == "realtime") return {};
  const std::string prefix = "realtime:";
  const auto factor = text.starts_with(prefix) ? parse_number(text.substr(prefix.size())) : std::nullopt;
  if (factor && *factor >= kLeastFactor && *factor <= kGreatestFactor) return {};
  return "must be lockstep, realtime or realtime:FACTOR with a factor within [0.001, 1000], not '" + text + "'";
}

std::string check_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, seed);
  const bool good = read.ec == std::errc() && read.ptr == end;
  return good ? "" : "'" + text + "' must be a whole number within [0, 18446744073709551615]";
}

std::string check_seconds(const std::string& text) {
  const auto value = parse_number(text);
  const bool good = value && *value > 0.0 && *value <= kLongestS;
  return good ? "" : "'" + text + "' must be a number of seconds above 0 and at most 36000";
}

std::string check_maps_period(const std::string& text) {
  const auto value = parse_number(text);
  const bool good = value && *value >= kLeastMapsPeriodS && *value <= kGreatestMapsPeriodS;
  return good ? "" : "'" + text + "' must be a number of seconds from 1 to 3600";
}

void refuse_empty_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (std::ranges::any_of(option->results(), &std::string::empty)) {
      throw InputError(option->get_name() + ": must not be empty; leave it out, or say what is meant");
    }
  }
  for (const CLI::App* command : app.get_subcommands()) refuse_empty_values(*command);
}

}  // namespace skein::cli
