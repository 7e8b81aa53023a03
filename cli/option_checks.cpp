#include "cli/option_checks.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/text/number_checks.hpp"
#include "core/text/text.hpp"
#include "core/text/utf8.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

constexpr double kLongestS = 36000.0, kLeastTimeoutS = 0.1, kLeastFactor = 0.001, kGreatestFactor = 1000.0;
constexpr double kLeastMapsPeriodS = 1.0, kGreatestMapsPeriodS = 3600.0;

}  // namespace

std::string check_clock(const std::string& text) {
  if (text == "lockstep" || text == "realtime") return {};
  const std::string prefix = "realtime:";
  const auto factor = text.starts_with(prefix) ? parse_number(text.substr(prefix.size())) : std::nullopt;
  if (factor && *factor >= kLeastFactor && *factor <= kGreatestFactor) return {};
  return "must be lockstep, realtime or realtime:FACTOR with a factor within [0.001, 1000], not '" + text + "'";
}

std::string check_seconds(const std::string& text) {
  const auto value = parse_number(text);
  const bool good = value && *value > 0.0 && *value <= kLongestS;
  return good ? "" : "'" + text + "' must be a number of seconds above 0 and at most 36000";
}

std::string check_timeout(const std::string& text) {
  const auto value = parse_number(text);
  const bool good = value && *value >= kLeastTimeoutS && *value <= kLongestTimeoutS;
  return good ? "" : "'" + text + "' must be a number of seconds from 0.1 to 36000";
}

std::string check_maps_period(const std::string& text) {
  const auto value = parse_number(text);
  const bool good = value && *value >= kLeastMapsPeriodS && *value <= kGreatestMapsPeriodS;
  return good ? "" : "'" + text + "' must be a number of seconds from 1 to 3600";
}

std::string check_file_to_write(const std::string& text) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(text, error);
  if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)) return {};
  return "'" + text + "' is not a regular file; name a new file, or one that can be replaced";
}

void refuse_leading_zeros(CLI::App& app) {
  for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    const std::string type = option->get_type_name();
    if (type.starts_with("INT") || type.starts_with("UINT")) option->transform(CLI::Validator(check_decimal, ""));
  }
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) refuse_leading_zeros(*command);
}

void check_paths(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (is_utf8(argument)) continue;
    throw InputError("the argument " + shell_word(argument) +
                     " is not in UTF-8, which Skein's own files need; rename the file or folder, or convert the text");
  }
  std::error_code error;
  const std::filesystem::path here = std::filesystem::current_path(error);
  if (error) throw InputError("the current folder cannot be found: " + error.message() + "; change to another one");
  if (!is_utf8(here)) throw InputError(here.string() + ": the name of the current folder is not in UTF-8; rename it");
}

}  // namespace skein::cli
