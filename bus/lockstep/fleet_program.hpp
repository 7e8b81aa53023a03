// Interface of a fleet's programs. The same classes run in a process of their own, started by main(), or together with
// the whole fleet in one process (one_process/), with the same command lines.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "bus/lockstep/lockstep_node.hpp"
#include "process/program.hpp"
#include "process/status/status_pipe.hpp"

namespace skein::bus {

/// A running program: its node, and its actions when the node ends.
/// Threads: one, except for on_stop() and obey(), which other threads may call: one call at a time, not during ended().
class FleetMember {
 public:
  FleetMember() = default;
  virtual ~FleetMember() = default;
  FleetMember(const FleetMember&) = delete;
  FleetMember& operator=(const FleetMember&) = delete;

  /// The current node. It is new, and not yet started, at first and after each ended() that returns nullopt.
  virtual LockstepNode& node() = 0;
  /// The bus of all of the program's participants.
  virtual Bus& bus() = 0;
  /// Called when the node has ended.
  /// @returns the program's exit code, once its report is handed in; nullopt: there is a new node.
  virtual std::optional<int> ended(NodeEnd end) = 0;

  /// True: the program gets no more turns once it is asked to end. False: it gets turns until its node ends.
  virtual bool stops_at_once() const { return true; }
  /// Called when the program is asked to end.
  virtual void on_stop() { node().inbox().wake(); }
  /// Simulates SIGKILL without freeing the program's memory: its participants disappear for all others. Only
  /// one_process/ calls it.
  virtual void vanish() { bus().vanish(); }
  /// Whether the program shares nothing with others but the bus, so that its turns (one at a time) may run on any
  /// thread, in parallel with other programs' turns. Only one_process/ calls it.
  virtual bool flies_beside() const { return false; }
  /// Called with each line from the launcher (process/status/status_lines.hpp).
  virtual void obey(const std::string& /*line*/) {}
};

/// A program before it runs: its name and options.
class FleetProgram {
 public:
  virtual ~FleetProgram() = default;
  virtual const char* name() const = 0;
  virtual void add_options(CLI::App& app) = 0;
  /// Called once, after the options are parsed. @param status  must outlive the member.
  /// @returns the running program; or an exit code, if the options ask for something else (--check), which is then
  /// done.
  /// @throws InputError if the input is wrong.
  virtual std::variant<int, std::unique_ptr<FleetMember>> prepare(const ProgramOptions& options,
                                                                  StatusPipe& status) = 0;
};

/// Implements main() for a program in a process of its own: see run_program() (process/program.hpp).
int run_fleet_program(FleetProgram& program, int argc, const char* const* argv);

}  // namespace skein::bus
