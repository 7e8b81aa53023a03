// A whole fleet in one process: sim_server, comm_router, station, and all agents whose strategies are linked into it,
// over the inproc bus. The launcher orders on the control pipe what to start (process/status/shared_lines.hpp).
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>
#include <string_view>

#include "core/text/number_checks.hpp"
#include "one_process/crew.hpp"
#include "one_process/death_notice.hpp"
#include "one_process/fleet_programs.hpp"
#include "one_process/order_queue.hpp"
#include "one_process/program_output.hpp"
#include "one_process/session.hpp"
#include "one_process/shared_turn.hpp"
#include "one_process/watchdog.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"

/// Exists only in builds with LeakSanitizer.
extern "C" void __lsan_do_leak_check(void) __attribute__((weak));

namespace skein::one_process {
namespace {

using namespace std::chrono_literals;

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
    } else if (idle >= Crew::kIdleRounds) {
      orders.wait(Crew::kNap);
    }
  }
}

}  // namespace
}  // namespace skein::one_process

int main(int argc, char** argv) {
  skein::take_fleet_environment(argv);
  using namespace skein;
  if (argc > 1 && std::string_view(argv[1]) == "--session") {
    const int code = one_process::run_session(argc, argv);
    one_process::DeathNotice::stand_down();
    std::cout.flush();
    ::_exit(code);  // see below
  }
  double patience_s = 60.0;
  std::string turn_page;
  int threads = 1;
  const auto add_options = [&](CLI::App& app) {
    app.description("Skein: a whole fleet in one process");
    app.add_option("--agent-timeout", patience_s, "Wall time that a program may take for one step [s], 0: no limit")
        ->check(CLI::Validator(check_timeout_or_none, ""));
    app.add_option("--threads", threads, "Number of threads; results do not depend on it")
        ->check(CLI::Range(1, static_cast<int>(TurnPage::kSeats)))
        ->capture_default_str();
    app.add_option("--turn-page", turn_page,
                   "File of the launcher in which this process notes which program computes now")
        ->group("Launcher");
  };
  const int code =
      run_program(programs::kOneProcess, argc, argv, add_options, [&](const ProgramOptions& options, StopSignal& stop) {
        if (threads > 1) one_process::ProgramOutput::lead_by_thread(std::cout);
        StatusPipe pipe(options.status_fd);
        one_process::DeathNotice::watch(options.status_fd);
        one_process::OrderQueue orders;
        const ControlPipe control(
            options.control_fd, [&](const std::string& line) { orders.add(line); }, [&] { orders.end(); });
        std::optional<TurnPage> page;
        if (!turn_page.empty()) page.emplace(turn_page);
        Workers workers(threads);
        const one_process::FleetPrograms programs{.for_each = one_process::shared_turn(workers)};
        one_process::Crew crew(
            pipe, [&programs](const std::string& name) { return programs.make(name); }, page ? &*page : nullptr,
            options.status_fd, threads > 1 ? &workers : nullptr);
        const one_process::Watchdog watchdog(crew, patience_s);
        one_process::fly(crew, orders, stop);
        return kExitDone;
      });
  one_process::DeathNotice::stand_down();
  std::cout.flush();
  if (__lsan_do_leak_check != nullptr) __lsan_do_leak_check();
  ::_exit(code);  // runs no destructors: killed programs must write nothing more, not even buffered output
}
