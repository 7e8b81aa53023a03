#include "process/empty_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein {
namespace {

[[noreturn]] void refuse_empty(const std::string& option) {
  throw InputError(option + ": must not be empty; leave it out, or say what is meant");
}

/// The words that follow an option on the command line: the one behind its '=', or those up to the next option.
std::vector<std::string> values_behind(const CLI::Option& option, const std::vector<std::string>& arguments) {
  const std::string name = option.get_name();
  std::vector<std::string> values;
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    if (arguments[i].starts_with(name + "=")) values.push_back(arguments[i].substr(name.size() + 1));
    if (arguments[i] != name) continue;
    const std::size_t end = option.get_allow_extra_args() ? arguments.size() : std::min(arguments.size(), i + 2);
    for (std::size_t k = i + 1; k < end && !arguments[k].starts_with("-"); ++k) values.push_back(arguments[k]);
  }
  return values;
}

}  // namespace

void refuse_empty_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (std::ranges::any_of(option->results(), &std::string::empty)) refuse_empty(option->get_name());
  }
  for (const CLI::App* command : app.get_subcommands()) refuse_empty_values(*command);
}

void refuse_empty_assignments(const CLI::App& app, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") return;
    if (!argument.starts_with("--") || !argument.ends_with("=")) continue;
    const std::string name = argument.substr(0, argument.size() - 1);
    if (app.get_option_no_throw(name) != nullptr) refuse_empty(name);
  }
}

void refuse_empty_items(const CLI::App& app, const std::vector<std::string>& arguments) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_delimiter() != ',' || option->count() == 0) continue;
    for (const std::string& value : values_behind(*option, arguments)) {
      const std::vector<std::string> items = split(value);
      if (std::ranges::find(items, std::string()) == items.end()) continue;
      throw InputError(option->get_name() + ": an item of '" + value + "' is empty; write one comma between two items");
    }
  }
  for (const CLI::App* command : app.get_subcommands()) refuse_empty_items(*command, arguments);
}

}  // namespace skein
