// Messages of this library to the user: one line each on stderr, which the launcher writes to the program's log.
#pragma once

#include <string>

namespace skein_ros {

inline constexpr int kFailed = 3;

void say(const std::string& text);
/// Writes the same text at most once.
void say_once(const std::string& text);
/// Writes `why`, and ends the process with exit code 3.
[[noreturn]] void fail(const std::string& why);

}  // namespace skein_ros
