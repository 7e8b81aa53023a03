// A command line of `skein` that has been parsed: the options of one command, and the function that executes it.
#pragma once

#include <any>
#include <concepts>
#include <functional>
#include <utility>

#include "cli/console.hpp"

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

}  // namespace skein::cli
