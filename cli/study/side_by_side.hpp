// Flights side by side: each is a child process with a log of its own.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/host/supervisor.hpp"

namespace skein::cli {

/// A launcher for one flight. Its log is in the flight's folder.
/// @param arguments  of `skein`, beginning with `run`
ProgramSpec flight_program(std::vector<std::string> arguments, const std::filesystem::path& dir);

/// From one thread, which must live as long as the flights.
class SideBySide {
 public:
  /// What starts flight `index`; its name does not matter. Nothing: not before another one is over; where none is in
  /// the air, all is over.
  using Start = std::function<std::optional<ProgramSpec>(std::size_t index)>;
  /// Told of each flight that came to its end.
  using Over = std::function<void(std::size_t index, const ExitStatus& exit)>;

  SideBySide(std::size_t at_once, const Console& console) : at_once_(at_once), console_(console) {}

  /// Flies these in their order, each with its part of the cores (cli/threads.hpp). Returns when none is in the air.
  /// Ctrl-C ends those in the air at their next step, a second one at once: nothing more starts then, and of a flight
  /// that did not go to its end nobody is told.
  /// @returns false when it was interrupted, also when only one of the flights was told to end.
  bool fly(std::deque<std::size_t> waiting, const Start& start, const Over& over);

 private:
  void on_interrupt();

  const std::size_t at_once_;
  const Console& console_;
  Supervisor supervisor_;
  std::map<std::string, std::size_t> in_the_air_;  ///< index of the flight by program
  bool interrupted_ = false;
};

}  // namespace skein::cli
