// The skein command: parses the command line, calls the command, and turns errors into a message and an exit code.
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <stdexcept>

#include "cli/command_line.hpp"
#include "cli/duration_variable.hpp"
#include "cli/help.hpp"
#include "cli/hunt/capsule_run.hpp"
#include "cli/option_checks.hpp"
#include "cli/standard_output.hpp"
#include "cli/tell_errors.hpp"
#include "host/environment.hpp"
#include "host/preflight.hpp"
#include "host/program_start.hpp"
#include "process/program.hpp"
#include "run/run_options.hpp"

namespace skein::cli {
namespace {

/// The command of these arguments. A mission without --duration gets the duration in the environment. A capsule does
/// not: it fixes its own flight completely. Nor does help, which must also help if the environment is wrong.
Command command_of(const std::vector<std::string>& arguments) {
  Command command = parse_command_line(arguments);
  const auto* run = command.get_if<RunOptions>();
  if (run != nullptr && is_capsule(*run)) return command;
  if (command.get_if<HelpText>() != nullptr) return command;
  const std::vector<std::string> completed = with_duration_of_environment(arguments);
  return completed == arguments ? command : parse_command_line(completed);
}

int execute(const std::vector<std::string>& arguments, const Console& console) try {
  return tell_errors(console, [&] {
    const Command command = command_of(arguments);
    const bool reads_paths = command.get_if<HelpText>() == nullptr && command.get_if<CompletionOptions>() == nullptr;
    if (reads_paths) check_paths(arguments);
    const int code = command.execute(console);
    if (const std::string lost = lost_output(); code == kExitDone && !lost.empty()) throw std::runtime_error(lost);
    return code;
  });
} catch (const Interrupted&) {
  return kExitInterrupted;
}

}  // namespace
}  // namespace skein::cli

int main(int argc, char** argv) {
  skein::cli::settle_process();
  std::signal(SIGXFSZ, SIG_IGN);  // at a file size limit the write fails, as on a full disk
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  return skein::cli::execute({argv + 1, argv + argc},
                             {std::cout, std::cerr, terminal, terminal && skein::cli::owns_terminal()});
}
