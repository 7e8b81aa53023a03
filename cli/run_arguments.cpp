#include "cli/run_arguments.hpp"

#include <spdlog/fmt/fmt.h>

#include <cstdlib>

#include "core/text/text.hpp"
#include "process/json_fields.hpp"

namespace skein::cli {
namespace {

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump();
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

std::vector<std::string> flight_words(const RunOptions& run) { return {kFlight, json_text(json_of(run))}; }

RunOptions flight_of(const std::string& json) {
  RunOptions run = struct_of<RunOptions>(parse_json(json));
  run.command = "skein " + shell_line(arguments_of(run));
  const char* const network = std::getenv(kNetworkVariable);
  if (!run.network && network != nullptr && *network != '\0') run.network = network;  // as if it were on a command line
  return run;
}

}  // namespace skein::cli
