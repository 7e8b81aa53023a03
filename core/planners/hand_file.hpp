// The file of a UAV that was flown by hand: what was wanted of it, from which step on. Who flies writes it
// (sim_server), and the planner `hand` flies it again. Each number is written so that it comes back to the bit.
// Columns: step, tick, and those of a HandCommand; ticks rise. SI and radians.   Pure but for the file; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/hand_command.hpp"

namespace skein {

struct HandRow {
  std::uint64_t step = 0;  ///< for people
  Tick tick = 0;           ///< of that step: from then on it is wanted
  HandCommand command;
};

namespace hand_file {

/// The first line, with its end.
std::string head();
/// A row as a line, with its end.
std::string line_of(const HandRow& row);
/// @throws InputError naming file and line when it is no such file, or cannot be read.
std::vector<HandRow> read(const std::filesystem::path& file);

}  // namespace hand_file
}  // namespace skein
