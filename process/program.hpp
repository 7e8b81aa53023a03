// Code that every main() shares: options, logging, signals, exit codes.
//
//   int main(int argc, char** argv) {
//     return skein::run_program("comm_router", argc, argv, {}, [](const skein::ProgramOptions& options,
//                                                                 skein::StopSignal& stop) {
//       const auto scenario = skein::load_scenario(options.scenario, options.load_options());
//       if (options.check_only) return 0;
//       ...
//     });
//   }
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "core/run/run_id.hpp"
#include "core/scenario/scenario_reader.hpp"

namespace CLI {
class App;
}
namespace spdlog {
class logger;
}

namespace skein {

/// Exit codes of all programs. [contract]
inline constexpr int kExitDone = 0;
inline constexpr int kExitCheckFailed = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitProcessFailed = 3;
inline constexpr int kExitInterrupted = 130;

/// Lowest domain of a fleet. Domain 0 is ROS 2's default: there any node of the host would receive the ground truth.
inline constexpr int kFirstDomain = 1;
/// Highest domain of a fleet. The ports of the RTPS standard's mapping end at domain 232.
inline constexpr int kLastDomain = 200;

/// Options that all programs understand.
struct ProgramOptions {
  std::string scenario = "towers";          ///< --scenario: name or path
  std::filesystem::path assets;             ///< --assets: folder that holds models/
  std::string dds = "cyclonedds";           ///< --dds: vendor
  int domain = kFirstDomain;                ///< --domain: base of the DDS domains, [1, 200]
  std::filesystem::path out = ".";          ///< --out: folder for what the program writes
  std::uint64_t seed = 0;                   ///< --seed: 0 draws nothing
  std::optional<std::uint64_t> scene_seed;  ///< --scene-seed
  std::optional<std::size_t> uavs;          ///< --uavs
  std::optional<double> duration_s;         ///< --duration
  std::optional<std::string> rules;         ///< --rules: a preset
  std::optional<std::string> conditions;    ///< --conditions: presets
  std::filesystem::path faults;             ///< --faults: fault file; empty: none
  std::string record = "run";               ///< --record: contents of the recording (recording/choice.hpp)
  bool check_only = false;                  ///< --check: validate the input, then stop
  int status_fd = -1;                       ///< --status-fd: where status_pipe.hpp writes; -1: nowhere
  std::optional<double> break_at_s;         ///< --break-at: see bus/lockstep/break_point.hpp
  bool wait_for_debugger = false;           ///< --wait-for-debugger: see debugger_wait.hpp
  bool keep = false;                        ///< --keep: see keeper.hpp
  int lives = 0;                            ///< with `keep`: number of workers so far, including this one
  double server_timeout_s = 0.0;            ///< --server-timeout: longest wait for sim_server to appear; 0: no limit
  std::filesystem::path health;             ///< --health: see heartbeat.hpp
  int control_fd = -1;                      ///< --control-fd: where the launcher's orders come from; -1: nowhere
  std::string log_level;                    ///< --log-level; empty: SKEIN_LOG, else info
  std::optional<std::string> network;       ///< --network: text for read_network(); none: this host only
  int lease_s = 8;                          ///< --lease: a program that is silent for this time is considered dead [s]
  RunId run = RunId::none;                  ///< --run: the run to which the program belongs
  /// --security: folder with the files of process/files/security_files.hpp; empty: not secured
  std::filesystem::path security;

  /// Whether a launcher runs the fleet: it reports dead programs, kills and restarts programs, and continues stopped
  /// ones.
  bool has_launcher() const { return control_fd >= 0; }
  /// Options for load_scenario().
  LoadOptions load_options() const;
  /// The same for a program that does not use the scene: the scene's files need not exist.
  LoadOptions load_options_without_scene() const;
  /// Checks, without a launcher, that the program can write files to `out`. The launcher makes the folder itself, and
  /// gets the reports through the status pipe, so its programs fly on without their files. @throws InputError
  void check_out() const;
};

/// Tells whether the program has been asked to end, by SIGINT, SIGTERM or stop(). Any thread.
class StopSignal {
 public:
  StopSignal() = default;
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  bool requested() const { return requested_.load(); }
  /// Sets the function that is called, in another thread, when the program is asked to end; if it has been asked
  /// already, calls the function at once. Replaces the previous function, and waits until a running call of that has
  /// returned: after on_stop({}), objects that it uses may be destroyed.
  void on_stop(std::function<void()> wake);
  /// Asks the program to end.
  void stop();

 private:
  std::atomic<bool> requested_ = false;
  std::mutex mutex_;
  std::function<void()> wake_;
};

using AddOptions = std::function<void(CLI::App&)>;
using ProgramBody = std::function<int(const ProgramOptions&, StopSignal&)>;

/// Parses the command line, sets up logging ("[name] level message" on stderr) and signals, and runs `body`.
/// An InputError becomes one message on stderr and exit code 2, as does a wrong command line (with a hint at --help);
/// any other exception becomes a message and exit code 3. While it runs, SIGINT and SIGTERM reach `body` as its
/// StopSignal and SIGPIPE is ignored. Call it once, from main().
/// @param add_options adds a program's own options; may be empty.
/// @returns the exit code: `body`'s, or one of the above.
int run_program(const std::string& name, int argc, const char* const* argv, const AddOptions& add_options,
                const ProgramBody& body);

// The parts of run_program(), for a process with several programs (one_process/).

/// Parses the command line. @returns the options; or an exit code, after --help or an error message on stderr.
std::variant<ProgramOptions, int> parse_program(const std::string& name, int argc, const char* const* argv,
                                                const AddOptions& add_options);
/// Creates a log that writes to stderr. @param level  empty: SKEIN_LOG, else info. @throws InputError for an unknown
/// level
std::shared_ptr<spdlog::logger> make_log(const std::string& name, const std::string& level);
/// Calls work(). @returns its exit code; if it throws, kExitBadInput (InputError) or kExitProcessFailed, after a
/// message on stderr.
int guarded(const std::string& name, const std::function<int()>& work);

}  // namespace skein
