// What this library tells the user: one line each on stderr, where the launcher's log has it.
#pragma once

#include <string>

namespace skein_ros {

inline constexpr int kFailed = 3;

void say(const std::string& text);
/// The same text at most once.
void say_once(const std::string& text);
/// Says why, and ends the process with exit code 3.
[[noreturn]] void fail(const std::string& why);

}  // namespace skein_ros
