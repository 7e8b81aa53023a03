// Finds where two runs diverge: the first step whose digests differ, and which fields of which entities differ in it.
// Threads: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein::results {

struct RunDifference {
  std::int64_t step = 0;
  double time_s = 0.0;              ///< simulated time of that step
  std::vector<std::string> fields;  ///< "jurong position", "radio": every field that differs there; never empty
};

/// Compares the `digests.csv` of two run folders line by line.
/// @returns the first difference, or nullopt when the runs are the same.
/// A last line without its end, as an aborted run leaves it, counts as the end of the file.
/// @throws InputError when a folder holds no digests.csv, or the file cannot be read or is not valid.
std::optional<RunDifference> first_difference(const std::filesystem::path& run_a, const std::filesystem::path& run_b);

}  // namespace skein::results
