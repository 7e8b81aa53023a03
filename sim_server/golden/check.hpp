// Runs reference vectors through the production code. The header row tells which table it is.   Threads: any.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein::sim {

struct GoldenReport {
  std::string table;  ///< scoring, gimbal, position_control, attitude_control or los_antenna
  std::size_t rows = 0;
  std::size_t failures = 0;           ///< rows in which a value is beyond its tolerance, or a flag differs
  double worst = 0.0;                 ///< greatest difference, as a share of its tolerance (<= 1 passes)
  std::string worst_column;           ///< column of that difference
  std::vector<std::string> messages;  ///< the first few failures: line, column, expected, computed
};

/// Checks every row of a table.
/// @throws InputError if the file cannot be read, is malformed, or its columns belong to no known table.
GoldenReport check_golden(const std::filesystem::path& file);

}  // namespace skein::sim
