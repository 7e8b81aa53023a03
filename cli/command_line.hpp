// The command line of `skein`, read into plain structs, and the command that it names: its options, and the function
// that executes it. Nothing is opened or started here. cli/command_parser.cpp, which knows all commands, parses it; it
// has no header of its own, because commands read the command lines of recorded runs.
#pragma once

#include <any>
#include <concepts>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

class Command {
 public:
  /// @param options  the struct of the command
  /// @param action   executes the command, and returns its exit code
  template <class Options, std::invocable<const Options&, const Console&> Action>
  Command(Options options, Action action)
      : options_(std::move(options)), action_([action](const std::any& any, const Console& console) {
          return action(std::any_cast<const Options&>(any), console);
        }) {}

  /// The options if they are of this type, else null.
  template <class Options>
  const Options* get_if() const {
    return std::any_cast<Options>(&options_);
  }

  /// A copy of the options. @throws std::bad_any_cast if they are of another type.
  template <class Options>
  Options get() const {
    return std::any_cast<Options>(options_);
  }

  /// @returns the exit code. @throws what the action throws: InputError, Interrupted and others.
  int execute(const Console& console) const { return action_(options_, console); }

 private:
  std::any options_;
  std::function<int(const std::any&, const Console&)> action_;
};

/// @param arguments without the program's name. @throws InputError for anything that does not fit.
Command parse_command_line(const std::vector<std::string>& arguments);

/// Calls `use` with all commands and their options, before anything is parsed: for help texts and completion.
void with_command_line(const std::function<void(const CLI::App&)>& use);

}  // namespace skein::cli
