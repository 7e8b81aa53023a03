// Parses a command line by the table of commands: parse_command_line() and with_command_line() of cli/command_line.hpp.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "cli/command_line.hpp"
#include "cli/command_table.hpp"
#include "cli/help.hpp"
#include "cli/option_checks.hpp"
#include "cli/place/host_service.hpp"
#include "cli/run_arguments.hpp"
#include "cli/run_command.hpp"
#include "cli/sweep/this_machine.hpp"
#include "cli/sweep_options.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "process/empty_options.hpp"
#include "process/manual.hpp"

namespace skein::cli {
namespace {

/// The command line with all commands, and the structs that CLI11 fills.
class OptionParser {
 public:
  OptionParser()
      : app("Skein: a fleet of inspection UAVs, simulated as separate processes that talk over DDS.", "skein") {
    app.require_subcommand(1);
    app.set_version_flag("--version", "skein " SKEIN_VERSION);
    app.failure_message(CLI::FailureMessage::simple);
    app.footer("Example:\n  skein run towers --planner kios\n\n`skein COMMAND --help` shows the options of a command.");
    for (const CommandEntry& entry : command_table()) {
      TakeCommand take = entry.add(app);
      CLI::App* added = app.get_subcommands([](const CLI::App*) { return true; }).back();
      added->group(entry.task);
      commands_.emplace_back(added, std::move(take));
    }
    refuse_leading_zeros(app);
  }

  /// The command that was parsed, with its options.
  Command take(const std::vector<std::string>& arguments) {
    for (const auto& [command, take] : commands_) {
      if (command->parsed()) return take(arguments);
    }
    throw InputError("no command was given");
  }

  CLI::App app;

 private:
  std::vector<std::pair<CLI::App*, TakeCommand>> commands_;
};

Command help(std::string text, bool names_planners = false) {
  return {HelpText{std::move(text), names_planners}, print_help};
}

/// The flight of --flight JSON. @throws InputError also for a value that `skein run` would refuse
Command flight_command(const std::vector<std::string>& words) {
  if (words.size() != 1) throw InputError(std::string(kFlight) + " is for Skein's own commands: --flight JSON");
  const RunOptions run = flight_of(words[0]);
  parse_command_line(arguments_of(run));
  return {run, run_fleet};
}

/// The commands that programs call, not users: --complete is for shells, --host for a launcher on another host, --unit
/// for engines of sweeps, --flight for commands that fly many runs.
std::optional<Command> internal_command(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return {};
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (arguments[0] == "--complete") return Command(CompletionOptions{rest}, print_completions);
  if (arguments[0] == kFlight) return flight_command(rest);
  if (arguments[0] == "--unit") return Command(unit_options(rest), run_unit);
  if (arguments[0] != "--host" || !rest.empty()) return {};
  return Command(HostOptions{}, [](const HostOptions&, const Console&) { return serve_host(); });
}

/// The command that the first word names; null: none.
const CLI::App* command_named(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty()) return nullptr;
  const auto commands = app.get_subcommands([&](const CLI::App* one) { return one->get_name() == arguments[0]; });
  return commands.empty() ? nullptr : commands[0];
}

/// Refuses a first word that names no command. CLI11 would only say that a command is missing. @throws InputError
void require_command(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments[0].empty() || arguments[0].starts_with("-")) return;
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(command->get_name());
  }
  if (std::ranges::find(known, arguments[0]) != known.end()) return;
  throw InputError("there is no command '" + shortened(arguments[0]) + "'; " + suggestion(arguments[0], known) +
                   "\nSee `skein --help`.");
}

/// "; did you mean '--planner'?" for the first argument that looks like an option and is none, if one is near; else "".
std::string nearest_option(const CLI::App& command, const std::vector<std::string>& arguments) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (const std::string& argument : arguments) {
    const std::string name = argument.substr(0, argument.find('='));
    if (!name.starts_with("--") || std::ranges::find(known, name) != known.end()) continue;
    const std::string words = suggestion(name, known);
    return words.starts_with("did you mean") ? "; " + words : "";
  }
  return "";
}

/// The message about an option's value that CLI11 cannot convert.
std::string of_value(const CLI::Option& option, const std::string& value) {
  const std::string type = option.get_type_name(), name = option.get_name() + ": ";
  if (type.empty()) return name + "takes no value, such as '" + value + "'; leave '=' and the value out";
  const bool whole = type.starts_with("INT") || type.starts_with("UINT");
  return name + "'" + value + "' must be a " + (whole ? "whole number of at most nine digits" : "number");
}

/// CLI11's message about a mistake, or a message of ours where CLI11's names no correct value.
std::string said_of(const CLI::ParseError& error, const CLI::App* command, const std::vector<std::string>& arguments) {
  const std::string words = error.what(), twice = ": At Most 1 required but received ", value = "Could not convert: ";
  if (const std::size_t at = words.find(twice); at != std::string::npos) {
    return words.substr(0, at) + ": is given " + words.substr(at + twice.size()) + " times; give it once";
  }
  if (command == nullptr) return words;
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError))
    return words + nearest_option(*command, arguments);
  const std::size_t equals = words.find(" = ");
  if (!words.starts_with(value) || equals == std::string::npos) return words;
  const CLI::Option* option = command->get_option_no_throw(words.substr(value.size(), equals - value.size()));
  return option == nullptr ? words : of_value(*option, words.substr(equals + 3));
}

}  // namespace

void with_command_line(const std::function<void(const CLI::App&)>& use) { use(OptionParser().app); }

Command parse_command_line(const std::vector<std::string>& arguments) {
  OptionParser parser;
  // Not for users: --manual is the source of the manual page, and a shell calls --complete.
  if (arguments == std::vector<std::string>{"--manual"}) return help(manual_of(parser.app, "skein"));
  if (const auto command = internal_command(arguments)) return *command;
  require_command(parser.app, arguments);
  const CLI::App* const command = command_named(parser.app, arguments);
  if (command != nullptr) refuse_empty_assignments(*command, arguments);
  const auto is = [&parser](const char* name) { return parser.app.got_subcommand(name); };
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
  try {
    parser.app.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    // The help of the command that was named, or else the general help.
    return help(parser.app.help(), is("run") || is("compose") || is("contest") || is("compare"));
  } catch (const CLI::CallForVersion& version) {
    return help(std::string(version.what()) + "\n");
  } catch (const CLI::ParseError& error) {
    throw InputError(said_of(error, command, arguments) + "\nSee `skein --help` or `skein COMMAND --help`.");
  }
  refuse_empty_values(parser.app);
  refuse_empty_items(parser.app, arguments);
  return parser.take(arguments);
}

}  // namespace skein::cli
