#include "cli/attach_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "debug/debuggee.hpp"
#include "host/fleets.hpp"
#include "host/proc_table.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

pid_t chosen_process(const RunningFleet& fleet, const std::string& member) {
  std::vector<std::string> known;
  for (const auto& [program, pid] : fleet.programs) {
    const std::string name = programs::is_agent(program) ? programs::member_name(program) : program;
    if (name == member) return pid;
    known.push_back(name);
  }
  throw InputError("attach: this fleet has no running program of " + member + "; " + suggestion(member, known));
}

/// Says how long the fleet waits for a program that a debugger has stopped.
std::string patience_text(const RunningFleet& fleet, const std::string& member) {
  const bool server = member == programs::kSimServer;
  const bool timed = fleet.agent_timeout_s > 0.0 && !server;
  const double limit_s = timed ? std::min(fleet.agent_timeout_s, fleet.lease_s) : fleet.lease_s;
  return fmt::format(
      "while {} is stopped, the fleet waits up to {} s of wall time, then {}; for more time, start the run with {}",
      member, shortest(limit_s), server ? "ends" : "goes on without it", timed ? "--agent-timeout 3600" : "--debug");
}

/// Says what to do at the debugger's first stop, which is hardly ever in the user's own code.
std::string first_steps_text(const std::string& member) {
  const std::string where = member + " stops in a system call, where it waits for the next exchange";
  const bool has_planner =
      member != programs::kSimServer && member != programs::kStation && member != programs::kCommRouter;
  return where + (has_planner ? ": set a breakpoint in your planner (`break YourPlanner::plan`), then `continue`"
                              : ": set a breakpoint, then `continue`");
}

/// The tool's command line, with the process id at its end.
std::vector<std::string> tool_words(const std::string& how, pid_t pid, const std::string& why) {
  const std::string process = std::to_string(pid);
  std::vector<std::string> words;
  if (how == "gdb") {
    words = gdb_words({"-p"});
  } else if (const auto port = gdbserver_port(how)) {
    words = {"gdbserver", "--once", "--attach", "127.0.0.1:" + std::to_string(*port)};
  } else {
    words = shell_words(how);
  }
  if (words.empty()) throw InputError(why + ": name a tool: gdb, gdbserver:PORT or a command");
  words[0] = tool_file(words[0], why);
  words.push_back(process);
  return words;
}

}  // namespace

void add_ps(CLI::App& app, PsOptions& /*none*/) {
  app.add_subcommand("ps", "List the fleets that fly now, with their processes")
      ->footer("Example:\n  skein ps\n\nSee docs/how-to-debug.md.");
}

void add_attach(CLI::App& app, AttachOptions& attach) {
  CLI::App* command =
      app.add_subcommand("attach", "Attach a debugger to one program of a flying fleet; the fleet waits meanwhile");
  command
      ->add_option("UAV", attach.what,
                   "UAV, gcs, sim_server, comm_router or station. TOOL: gdb (default), gdbserver:PORT, or a command "
                   "that takes a process id as its last argument")
      ->required()
      ->type_name("UAV[=TOOL]");
  command->add_option("--run", attach.run, "Results folder of the fleet (default: the only fleet that flies)");
  command->footer(
      "Examples:\n"
      "  skein attach jurong\n"
      "  skein attach jurong='strace -f -p' --run runs/towers-kios-0\n\n"
      "`skein ps` lists the fleets that fly. See docs/how-to-debug.md.");
}

int list_fleets(const PsOptions& /*options*/, const Console& console) {
  const std::vector<RunningFleet> fleets = running_fleets(::geteuid());
  if (fleets.empty()) console.err << "no fleet of yours is flying" << std::endl;
  for (const RunningFleet& fleet : fleets) {
    const auto time_s = simulated_s(fleet);
    console.out << shown_folder(fleet.dir) << ": " << std::filesystem::path(fleet.scenario).stem().string()
                << (time_s ? fmt::format(", simulated {:.0f} s", *time_s) : ", starts") << ", DDS domains from "
                << fleet.base_domain << (fleet.launcher ? fmt::format(", launcher {}", *fleet.launcher) : "")
                << (fleet.elsewhere ? ", in another network namespace" : "") << '\n';
    for (const auto& [program, pid] : fleet.programs) {
      console.out << fmt::format("  {:<24} {:>8}  {}\n", program, pid, state_text(pid));
    }
  }
  console.out << std::flush;
  return kExitDone;
}

int attach_to(const AttachOptions& options, const Console& console) {
  const std::size_t cut = options.what.find('=');
  const std::string member = options.what.substr(0, cut);
  const std::string how = cut == std::string::npos ? "gdb" : options.what.substr(cut + 1);
  const RunningFleet fleet = chosen_fleet(options.run, "attach", "--run");
  const pid_t pid = chosen_process(fleet, member);
  const std::string why = "attach " + options.what;
  if (tracer_of(pid) != 0) throw InputError(why + ": it is already " + state_text(pid));
  std::vector<std::string> words = tool_words(how, pid, why);
  console.err << patience_text(fleet, member) << '\n' << first_steps_text(member) << std::endl;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  throw std::system_error(errno, std::generic_category(), words[0]);
}

}  // namespace skein::cli
