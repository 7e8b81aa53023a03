// The part of FleetRun for programs under --debug. They are not children of the launcher, and the user may keep them
// for any time.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <csignal>

#include "results/run_folder.hpp"
#include "run/fleet_run.hpp"

namespace skein::cli {

/// A debugged program, or the tool that it runs in, has ended.
void FleetRun::on_debugged_exit(Event& event) {
  debug_->on_exit(event.program);
  if (leave_by_.is_set() && !facts_.interrupted) leave_by_.set(leave_time());  // the others waited for it
  // A tool does not end by the signal that killed its program: count the fault's SIGKILL as the tool's.
  if (orders_->out().contains(event.program) && debug_->take_back(event.program)) event.exit.signal = SIGKILL;
}

/// A debugged program that ends is lost like any other program, whether or not the user has left the debugger.
void FleetRun::on_debugged_end(const DebugWatch& watch) {
  const auto& [member, program, how, port, tool, here] = watch.debuggee();
  if (server_done_ || ending_ || !debug_->lose(program)) return;
  if (orders_->out().contains(program)) return;
  const bool of_server = program == programs::kSimServer;
  view_.message(fmt::format("the debugged program of {}{} has ended; the fleet {}", member,
                            watch.pid() == 0 ? "" : fmt::format(" (process {})", watch.pid()),
                            of_server ? "ends with it" : "goes on without it"));
  facts_.warnings.push_back("the debugged program of " + member + " ended before the run did");
  if (!of_server) return tell_lost(member);
  failed_ = true;
  end_all();
}

/// Whether a debugged program runs, and Ctrl-C was not pressed: then programs have no deadline for leaving.
bool FleetRun::being_debugged() const {
  return !facts_.interrupted && std::any_of(plan_.debug.begin(), plan_.debug.end(),
                                            [&](const Debuggee& debuggee) { return host_->running(debuggee.program); });
}

}  // namespace skein::cli
