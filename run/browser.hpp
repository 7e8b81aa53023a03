// Starts the user's browser, for a page that this command serves.   Threads: any.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace skein::cli {

/// The command line that opens a file in a browser: the first command in $BROWSER that exists, else xdg-open. Empty if
/// there is no display, no such command, or the user is logged in from another machine (ssh).
/// @param variable  returns the value of an environment variable; null: it is not set
std::vector<std::string> browser_command(const std::filesystem::path& file,
                                         const std::function<const char*(const char*)>& variable);

/// Starts a browser in a session of its own, with its output discarded; it may outlive this command.
/// @returns false if no process could be created; does not notice if the browser itself fails to start.
bool start_browser(const std::vector<std::string>& command);

}  // namespace skein::cli
