// Runs several flights at once, each as a child process with a log of its own.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "cli/console.hpp"
#include "host/supervisor.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

/// The `skein` process for one flight. Its log is in the flight's folder, `run.out`.
/// @param variables  to set in its environment
ProgramSpec flight_program(const RunOptions& run, const std::map<std::string, std::string>& variables = {});

/// Threads: one, which must live as long as the flights.
class SideBySide {
 public:
  /// Returns the program for flight `index` (its name is ignored). nullopt: fly() asks again when another flight has
  /// ended, and returns if no flight is running.
  using Start = std::function<std::optional<ProgramSpec>(std::size_t index)>;
  /// Receives each flight that has ended, also with an error.
  using Over = std::function<void(std::size_t index, const ExitStatus& exit)>;

  SideBySide(std::size_t at_once, const Console& console) : at_once_(at_once), console_(console) {}

  /// Flies these flights in order, each with its share of the cores (host/threads.hpp). Returns when none is running.
  /// Ctrl-C ends running flights at their next step, a second Ctrl-C at once. Then no more flights start, and `over` is
  /// only called for flights with exit code 0.
  /// @returns false if it was interrupted, also if only one of the flights was interrupted.
  bool fly(std::deque<std::size_t> waiting, const Start& start, const Over& over);

 private:
  void on_interrupt();

  const std::size_t at_once_;
  const Console console_;
  Supervisor supervisor_;
  std::map<std::string, std::size_t> running_;  ///< index of the flight by program
  bool interrupted_ = false;
};

}  // namespace skein::cli
