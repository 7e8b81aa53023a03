// Messages of this library to the user: one line each on stderr, which the launcher writes to the program's log.
#pragma once

#include <string>

namespace skein_ros {

inline constexpr int kFailed = 3;  ///< exit code of fail()

/// Writes one line with `text`.
void say(const std::string& text);
/// Writes `text` unless this process has written the same text with say_once() before. Any thread.
void say_once(const std::string& text);
/// Writes `why`, and ends the process at once, without destructors, with exit code kFailed.
[[noreturn]] void fail(const std::string& why);

}  // namespace skein_ros
