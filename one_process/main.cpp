// A fleet in one process: sim_server, comm_router, station and all agents with the strategies that are linked with it,
// over the inproc bus. The launcher says on the control pipe what is to be started (process/shared_lines.hpp).
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>

#include "comm_router/router_program.hpp"
#include "core/number_checks.hpp"
#include "one_process/crew.hpp"
#include "one_process/death_notice.hpp"
#include "one_process/order_queue.hpp"
#include "one_process/watchdog.hpp"
#include "process/environment.hpp"
#include "process/run_folder.hpp"
#include "sim_server/server_program.hpp"
#include "station/station_program.hpp"
#include "uav_agent/agent_program.hpp"

/// Of LeakSanitizer, where the program is built with it.
extern "C" void __lsan_do_leak_check(void) __attribute__((weak));

namespace skein::one_process {
namespace {

using namespace std::chrono_literals;

/// Nobody has anything to do for so many rounds: they wait for a clock.
constexpr int kIdleRounds = 3;
constexpr auto kNap = 100us;

/// More than a large fleet hears in a step.
constexpr std::size_t kFramesRemembered = 256;

/// @param frames  for all agents
std::unique_ptr<bus::FleetProgram> make_program(const std::string& name,
                                                const std::shared_ptr<agent::ReadyFrames>& frames) {
  if (name == programs::kSimServer) return std::make_unique<sim::ServerProgram>();
  if (name == programs::kCommRouter) return std::make_unique<router::RouterProgram>();
  if (name == programs::kStation) return std::make_unique<station::StationProgram>();
  return std::make_unique<agent::AgentProgram>(frames);
}

void fly(Crew& crew, OrderQueue& orders, const StopSignal& stop) {
  bool asked = false;
  int idle = 0;
  while (true) {
    for (const shared_lines::Order& order : orders.take()) crew.obey(order);
    if (stop.requested() && !std::exchange(asked, true)) crew.stop();
    if (crew.empty() && orders.over()) return;
    idle = crew.round() ? 0 : idle + 1;
    if (crew.empty()) {
      orders.wait(100ms);
    } else if (idle >= kIdleRounds) {
      orders.wait(kNap);
    }
  }
}

}  // namespace
}  // namespace skein::one_process

int main(int argc, char** argv) {
  skein::take_fleet_environment(argv);
  using namespace skein;
  double patience_s = 60.0;
  std::string turn_page;
  const auto add_options = [&](CLI::App& app) {
    app.description("Skein: home of a whole fleet in one process");
    app.add_option("--agent-timeout", patience_s, "wall time that a program may take for one turn [s], 0: for ever")
        ->check(CLI::Validator(check_not_negative, "NONNEGATIVE"));
    app.add_option("--turn-page", turn_page, "File of the launcher that takes whose turn it is")->group("Launcher");
  };
  const int code =
      run_program(programs::kOneProcess, argc, argv, add_options, [&](const ProgramOptions& options, StopSignal& stop) {
        StatusPipe pipe(options.status_fd);
        one_process::DeathNotice::watch(options.status_fd);
        one_process::OrderQueue orders;
        const ControlPipe control(
            options.control_fd, [&](const std::string& line) { orders.add(line); }, [&] { orders.end(); });
        const auto frames = std::make_shared<agent::ReadyFrames>(one_process::kFramesRemembered);
        std::optional<TurnPage> page;
        if (!turn_page.empty()) page.emplace(turn_page);
        one_process::Crew crew(
            pipe, [&](const std::string& name) { return one_process::make_program(name, frames); },
            page ? &*page : nullptr, options.status_fd);
        const one_process::Watchdog watchdog(crew, patience_s);
        one_process::fly(crew, orders, stop);
        return kExitDone;
      });
  one_process::DeathNotice::stand_down();
  std::cout.flush();
  if (__lsan_do_leak_check != nullptr) __lsan_do_leak_check();
  ::_exit(code);  // programs that were killed have no last words, nor have the files that they had open
}
