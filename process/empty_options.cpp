#include "process/empty_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/types.hpp"

namespace skein {
namespace {

[[noreturn]] void refuse_empty(const std::string& option) {
  throw InputError(option + ": must not be empty; leave it out, or say what is meant");
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

}  // namespace skein
