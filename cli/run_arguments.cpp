#include "cli/run_arguments.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdlib>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/text/utf8.hpp"
#include "core/types.hpp"
#include "process/json_fields.hpp"

namespace skein::cli {
namespace {

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump();
}

/// Notes the names of all options of a flight, for describe().
struct OptionNames {
  void field(const char* name, const auto&) { names.emplace_back(name); }
  std::vector<std::string> names;
};

/// Refuses what struct_of() ignores: a user may have written the JSON, or another build. @param run  that was read
void check_flight(const Json& given, const RunOptions& run) {
  const std::string flight = kFlight;
  if (!given.is_object()) {
    throw InputError(flight + R"( is for Skein's own commands: --flight '{"scenario": "towers", "seed": 3}')");
  }
  OptionNames known;
  RunOptions usual;
  describe(known, usual);
  const Json read = json_of(run);
  for (const auto& [name, value] : given.items()) {
    if (std::ranges::find(known.names, name) == known.names.end()) {
      throw InputError(flight + ": a flight has no option '" + shortened(name) + "'; " + suggestion(name, known.names));
    }
    if (value_or(read, name.c_str(), nullptr) == value) continue;
    throw InputError(flight + ": \"" + name + "\": " + shortened(json_text(value)) + " is of the wrong kind" +
                     (run.one_process ? ", or does not go with one-process" : ""));
  }
}

}  // namespace

std::vector<std::string> arguments_of(const RunOptions& run) {
  const Json options = json_of(run), usual = json_of(RunOptions{});
  std::vector<std::string> arguments = {"run", run.scenario};
  for (const auto& [name, value] : options.items()) {
    if (name == "scenario") continue;
    if (value.is_boolean()) {
      if (value != usual.at(name)) arguments.push_back((value.get<bool>() ? "--" : "--no-") + name);
      continue;
    }
    for (const Json& one : value.is_array() ? value : Json::array({value})) {
      arguments.push_back("--" + name + "=" + value_text(one));
    }
  }
  return arguments;
}

std::vector<std::string> flight_words(const RunOptions& run) try {
  return {kFlight, json_of(run).dump()};
} catch (const Json::exception&) {  // json_text() would replace bytes, and name another folder
  throw InputError("this flight has names that are not in UTF-8; rename the file or folder: skein " +
                   as_utf8(shell_line(arguments_of(run))));
}

RunOptions flight_of(const std::string& json) {
  const Json given = parse_json(json);
  RunOptions run = struct_of<RunOptions>(given);
  check_flight(given, run);
  run.command = "skein " + shell_line(arguments_of(run));
  const char* const network = std::getenv(kNetworkVariable);
  if (!run.network && network != nullptr && *network != '\0') run.network = network;  // as if it were on a command line
  return run;
}

}  // namespace skein::cli
