// The file of a pilot's commands to a UAV that was flown by hand. sim_server writes it during the flight, and the
// planner `hand` flies the commands again. Each number is written so that reading it returns the same bits.
// Columns: step, tick, and those of a HandCommand; ticks increase.   Units: SI and radians.
// Pure except for read(); safe from any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/messages/hand_command.hpp"

namespace skein {

struct HandRow {
  std::uint64_t step = 0;  ///< for readers of the file; the planner ignores it
  Tick tick = 0;           ///< beginning of that step; the command holds from then on
  HandCommand command;
};

namespace hand_file {

/// The first line of the file, including the newline.
std::string head();
/// A row as a line, including the newline.
std::string line_of(const HandRow& row);
/// @throws InputError if the file cannot be read, is not a file of commands, or has a tick that is not greater than the
///   one before it. The message names the file, and the line if a line is wrong.
std::vector<HandRow> read(const std::filesystem::path& file);

}  // namespace hand_file
}  // namespace skein
