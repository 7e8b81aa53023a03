#include "bus/lockstep/fleet_program.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "bus/lockstep/break_point.hpp"
#include "bus/lockstep/self_signal.hpp"
#include "process/health/debugger_wait.hpp"
#include "process/health/heartbeat.hpp"

namespace skein::bus {
namespace {

/// Without a launcher, no other process could continue a stopped program. So a fault that stops the program only
/// removes it from the run: it asks to join again at once, and waits until the fault is over.
void stand_aside() {
  spdlog::info("no launcher could continue this program: it leaves the run and joins again when the fault ends");
}

/// How long to look for the server [s]. A program that is restarted during a run finds it soon, or the run is over.
double patience_with_server_s(const ProgramOptions& options) {
  constexpr double kInLaterLives_s = 8.0;
  if (options.lives <= 1) return options.server_timeout_s;
  return options.server_timeout_s > 0.0 ? std::min(options.server_timeout_s, kInLaterLives_s) : kInLaterLives_s;
}

int work(FleetMember& member, StopSignal& stop, const ProgramOptions& options) {
  Heartbeat health(options.health);
  std::optional<int> code;
  while (!code) {
    member.node().give_up_after(patience_with_server_s(options));
    stop.on_stop([&member] { member.on_stop(); });
    const NodeEnd end = run_node(member.node(), member.stops_at_once() ? &stop : nullptr, [&] { health.beat(); });
    stop.on_stop({});
    code = member.ended(end);
  }
  return *code;
}

}  // namespace

int run_fleet_program(FleetProgram& program, int argc, const char* const* argv) {
  return run_program(
      program.name(), argc, argv, [&](CLI::App& app) { program.add_options(app); },
      [&](const ProgramOptions& options, StopSignal& stop) {
        if (!options.has_launcher()) set_self_signals({.kill = {}, .stop = stand_aside});
        StatusPipe status(options.status_fd);
        const auto prepared = program.prepare(options, status);
        if (const int* code = std::get_if<int>(&prepared)) return *code;
        if (options.break_at_s) set_break_at(*options.break_at_s);
        if (options.wait_for_debugger) wait_for_debugger([&] { return stop.requested(); });
        FleetMember& member = *std::get<std::unique_ptr<FleetMember>>(prepared);
        const ControlPipe control(options.control_fd, [&](const std::string& line) { member.obey(line); });
        return work(member, stop, options);
      });
}

}  // namespace skein::bus
