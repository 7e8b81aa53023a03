// One of a fleet's programs: what its main() runs in a process of its own, and what a process that is home to the whole
// fleet (one_process/) makes of the same command line.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "bus/lockstep/lockstep_node.hpp"
#include "process/program.hpp"
#include "process/status/status_pipe.hpp"

namespace skein::bus {

/// A program at work: its node, and what it does when that has ended.
/// Threads: one, but for on_stop() and obey(), which only one at a time may call, and not beside ended().
class FleetMember {
 public:
  FleetMember() = default;
  virtual ~FleetMember() = default;
  FleetMember(const FleetMember&) = delete;
  FleetMember& operator=(const FleetMember&) = delete;

  /// Not yet started. Another one after each ended() that returns nullopt.
  virtual LockstepNode& node() = 0;
  /// All that it has on the bus.
  virtual Bus& bus() = 0;
  /// Its node has ended so.
  /// @returns the program's exit code, once its report is handed in; nullopt: there is a new node.
  virtual std::optional<int> ended(NodeEnd end) = 0;

  /// Whether a program that is asked to end gets no more turns. Else it takes those in which it comes to its end.
  virtual bool stops_at_once() const { return true; }
  /// It is asked to end.
  virtual void on_stop() { node().inbox().wake(); }
  /// It is killed, and its memory is kept: of all that others see of it nothing stays. Only one_process/ does that.
  virtual void vanish() { bus().vanish(); }
  /// Whether its turns, one at a time, may be on any thread and beside those of other programs: it shares nothing with
  /// them but the bus. Only one_process/ asks.
  virtual bool flies_beside() const { return false; }
  /// A line of the launcher's (process/status/status_lines.hpp).
  virtual void obey(const std::string& /*line*/) {}
};

/// What a program is before it is at work.
class FleetProgram {
 public:
  virtual ~FleetProgram() = default;
  virtual const char* name() const = 0;
  virtual void add_options(CLI::App& app) = 0;
  /// Once, after the options are read. @param status  must outlive the member.
  /// @returns the program at work; or an exit code, after it has done what else its options asked for (--check).
  /// @throws InputError for what is wrong in its input.
  virtual std::variant<int, std::unique_ptr<FleetMember>> prepare(const ProgramOptions& options,
                                                                  StatusPipe& status) = 0;
};

/// All of a main(): see run_program() (process/program.hpp).
int run_fleet_program(FleetProgram& program, int argc, const char* const* argv);

}  // namespace skein::bus
