// Format of a line in a program's log: "[comm_router] warning text". For run_program(), which configures the logs, and
// for code that searches them.
#pragma once

#include <string_view>

namespace skein::log_lines {

/// Pattern for spdlog: name, level, text.
inline constexpr const char* kPattern = "[%n] %l %v";
/// The same with the simulated time after the name (log_time.hpp).
inline constexpr const char* kTimedPattern = "[%n%*] %l %v";

inline bool is_warning(std::string_view line) {
  const std::size_t name_end = line.find("] ");
  return line.starts_with('[') && name_end != std::string_view::npos &&
         line.substr(name_end + 2).starts_with("warning ");
}

}  // namespace skein::log_lines
