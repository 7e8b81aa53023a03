#include "process/program.hpp"

#include <fcntl.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "core/text/number_checks.hpp"
#include "core/text/suggestion.hpp"
#include "process/empty_options.hpp"
#include "process/files/nowhere.hpp"
#include "process/files/path_error.hpp"
#include "process/health/crash_notes.hpp"
#include "process/health/keeper.hpp"
#include "process/host/environment.hpp"
#include "process/host/open_files.hpp"
#include "process/log_lines.hpp"
#include "process/manual.hpp"

namespace skein {
namespace {

/// Write end of the pipe that carries signals to a thread. A signal handler can reach nothing but a global, and
/// may do little more than write(); everything else happens in SignalThread.
std::atomic<int> signal_pipe_fd = -1;

extern "C" void on_signal(int) {
  const int saved = errno;
  const char stop = 's';
  static_cast<void>(!::write(signal_pipe_fd.load(), &stop, 1));
  errno = saved;
}

/// Turns SIGINT and SIGTERM into StopSignal::stop() while it lives.
class SignalThread {
 public:
  explicit SignalThread(StopSignal& stop) {
    if (::pipe2(pipe_.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe for signals");
    signal_pipe_fd = pipe_[1];
    thread_ = std::thread([this, &stop] { run(stop); });
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, &old_interrupt_);
    ::sigaction(SIGTERM, &action, &old_terminate_);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);  // exceeding a file-size limit is like a full disk: write() reports it
  }
  ~SignalThread() {
    ::sigaction(SIGINT, &old_interrupt_, nullptr);
    ::sigaction(SIGTERM, &old_terminate_, nullptr);
    const char quit = 'q';
    static_cast<void>(!::write(pipe_[1], &quit, 1));
    thread_.join();
    signal_pipe_fd = -1;
    ::close(pipe_[0]);
    ::close(pipe_[1]);
  }
  SignalThread(const SignalThread&) = delete;
  SignalThread& operator=(const SignalThread&) = delete;

 private:
  void run(StopSignal& stop) const {
    char order = 0;
    while (true) {
      const ssize_t size = ::read(pipe_[0], &order, 1);
      if (size < 0 && errno == EINTR) continue;
      if (size != 1 || order == 'q') return;
      stop.stop();
    }
  }

  std::array<int, 2> pipe_{};
  struct sigaction old_interrupt_ {
  }, old_terminate_{};
  std::thread thread_;
};

void add_common_options(CLI::App& app, ProgramOptions& options) {
  app.add_option("--scenario", options.scenario, "Name under config/scenarios/, or a YAML file")->capture_default_str();
  app.add_option("--assets", options.assets, "Folder that holds CARIC's models/ (default: SKEIN_ASSETS)");
  app.add_option("--dds", options.dds, "DDS vendor")->capture_default_str();
  app.add_option("--domain", options.domain, "First DDS domain of the fleet")
      ->capture_default_str()
      ->check(CLI::Range(kFirstDomain, kLastDomain));
  app.add_option("--out", options.out, "Folder for what the program writes")->capture_default_str();
  app.add_option("--seed", options.seed,
                 "Seed of the random effects; 0: without those of start places, command latency and LiDARs")
      ->capture_default_str()
      ->check(CLI::Validator(check_seed, "NONNEGATIVE"));
  app.add_option("--scene-seed", options.scene_seed, "Seed of a procedural scene, instead of the scenario's")
      ->check(CLI::Validator(check_seed, "NONNEGATIVE"));
  app.add_option("--uavs", options.uavs, "Fleet size, instead of the scenario's")
      ->check(CLI::Validator(check_positive, "POSITIVE"));
  app.add_option("--duration", options.duration_s, "Mission time [s], instead of the scenario's");
  app.add_option("--rules", options.rules, "Preset of rules, instead of the scenario's");
  app.add_option("--conditions", options.conditions, "Presets of conditions, instead of the scenario's");
  app.add_option("--record", options.record, "What goes into recording.mcap: none, messages, run, all or clouds")
      ->check(CLI::IsMember({"none", "messages", "run", "all", "clouds"}))
      ->capture_default_str();
  app.add_option("--faults", options.faults, "Fault file: what goes wrong, and when");
  app.add_flag("--check", options.check_only, "Check the input, then stop");
  app.add_option("--status-fd", options.status_fd, "File descriptor for status lines")->group("Launcher");
  app.add_option("--control-fd", options.control_fd, "File descriptor with orders")->group("Launcher");
  app.add_option("--security", options.security, "Folder with the process's key, certificate and permissions")
      ->group("Launcher");
  app.add_option("--server-timeout", options.server_timeout_s,
                 "Wall time to wait for sim_server to appear [s], 0: no limit; a program that was started again waits "
                 "at most 8 s")
      ->capture_default_str()
      ->check(CLI::Validator(check_not_negative, "NONNEGATIVE"));
  app.add_option("--health", options.health,
                 "File whose modification time the program updates while it makes progress, for health checks");
  app.add_option("--break-at", options.break_at_s, "Stop the debugger in the exchange before this simulated time [s]");
  app.add_flag("--wait-for-debugger", options.wait_for_debugger,
               "Wait before the first step until a debugger is attached, or SIGCONT arrives");
  app.add_flag("--keep", options.keep, "Start the program again whenever it has been killed");
  app.add_option("--log-level", options.log_level, "trace, debug, info, warn, error or off (default: SKEIN_LOG)");
  app.add_option("--network", options.network,
                 "Let programs on other hosts take part: over this interface, over those that the DDS vendor chooses "
                 "(all), or as a YAML file (or its text in braces) says for each domain")
      ->envname("SKEIN_NETWORK")
      ->expected(0, 1)
      ->default_str("all");
  app.add_option("--lease", options.lease_s, "Time of silence after which a program counts as dead [s]")
      ->capture_default_str()
      ->check(CLI::Range(1, 3600));
  app.add_option_function<std::uint64_t>(
         "--run", [&options](std::uint64_t run) { options.run = RunId{run}; },
         "Number of the run; the program ignores messages of other runs")
      ->envname(kRunVariable)
      ->check(CLI::Validator(check_seed, ""))
      ->group("Launcher");
}

}  // namespace

LoadOptions ProgramOptions::load_options() const {
  LoadOptions load;
  load.assets_dir = assets;
  load.duration_s = duration_s;
  load.scene_seed = scene_seed;
  load.uavs = uavs;
  load.rules = rules;
  load.conditions = conditions;
  return load;
}

LoadOptions ProgramOptions::load_options_without_scene() const {
  LoadOptions load = load_options();
  load.needs_scene_files = false;
  return load;
}

void ProgramOptions::check_out() const {
  if (has_launcher() || status_fd >= 0 || out == kNowhere) return;
  const auto refuse = [&](const std::string& reason) {
    throw InputError("--out " + out.string() + ": " + reason + "; make this folder first, or choose another one");
  };
  std::error_code error;  // e.g. the name is too long
  const auto kind = std::filesystem::status(out, error).type();
  if (kind == std::filesystem::file_type::not_found) refuse("does not exist");
  if (kind == std::filesystem::file_type::none) refuse("cannot be read (" + error.message() + ")");
  if (kind != std::filesystem::file_type::directory) refuse("is no folder");
  if (::access(out.c_str(), W_OK | X_OK) != 0) {
    refuse("cannot be written to (" + std::generic_category().message(errno) + ")");
  }
}

void StopSignal::on_stop(std::function<void()> wake) {
  const std::lock_guard lock(mutex_);
  wake_ = std::move(wake);
  if (requested_ && wake_) wake_();
}

void StopSignal::stop() {
  const std::lock_guard lock(mutex_);
  requested_ = true;
  if (wake_) wake_();
}

std::variant<ProgramOptions, int> parse_program(const std::string& name, int argc, const char* const* argv,
                                                const AddOptions& add_options) {
  CLI::App app("Skein: " + name, name);
  ProgramOptions options;
  add_common_options(app, options);
  const auto wrong = [&](const std::exception& error) {
    std::cerr << name << ": " << error.what() << "\nRun '" << name << " --help' for the options.\n";
    return kExitBadInput;
  };
  try {
    if (add_options) add_options(app);
    if (argc == 2 && std::string_view(argv[1]) == "--manual") {  // printed as --version would be
      throw CLI::CallForVersion(manual_of(app, std::filesystem::path(argv[0]).filename()), 0);
    }
    const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    refuse_empty_assignments(app, arguments);
    app.parse(argc, argv);
    refuse_empty_values(app);
    refuse_empty_items(app, arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --manual
    return wrong(error);
  } catch (const InputError& error) {
    return wrong(error);
  }
  return options;
}

std::shared_ptr<spdlog::logger> make_log(const std::string& name, const std::string& level_option) {
  std::string level = level_option;
  const char* from_environment = std::getenv("SKEIN_LOG");
  if (level.empty() && from_environment) level = from_environment;
  if (level.empty()) level = "info";
  static const std::vector<std::string> known = {"trace", "debug", "info", "warn", "error", "off"};
  if (std::find(known.begin(), known.end(), level) == known.end()) {
    throw InputError((level_option.empty() ? "SKEIN_LOG: '" : "--log-level: '") + level + "' is not a level; " +
                     suggestion(level, known));
  }
  auto logger = std::make_shared<spdlog::logger>(name, std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern(log_lines::kPattern);
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::trace);
  return logger;
}

int guarded(const std::string& name, const std::function<int()>& work) {
  try {
    return work();
  } catch (const InputError& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return kExitBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << name << ": " << path_error_text(error) << open_files_hint(error.code()) << '\n';
    return is_wrong_path(error) ? kExitBadInput : kExitProcessFailed;
  } catch (const std::system_error& error) {
    std::cerr << name << ": failed: " << error.what() << open_files_hint(error.code()) << '\n';
    return kExitProcessFailed;
  } catch (const std::exception& error) {
    std::cerr << name << ": failed: " << error.what() << '\n';
    return kExitProcessFailed;
  }
}

int run_program(const std::string& name, int argc, const char* const* argv, const AddOptions& add_options,
                const ProgramBody& body) {
  auto options = parse_program(name, argc, argv, add_options);
  if (const int* code = std::get_if<int>(&options)) return *code;
  return guarded(name, [&] {
    auto& parsed = std::get<ProgramOptions>(options);
    if (const auto code = parsed.keep ? keep_alive(parsed.lives) : std::nullopt) return *code;
    note_crashes(parsed.out);
    spdlog::set_default_logger(make_log(name, parsed.log_level));
    StopSignal stop;
    const SignalThread signals(stop);
    return body(parsed, stop);
  });
}

}  // namespace skein
