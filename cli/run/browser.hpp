// The user's own browser, for a page that this command serves.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace skein::cli {

/// What opens a file in a browser here: the first command of $BROWSER that there is, else xdg-open. Empty where there
/// is no screen, no such command, or the user sits at another machine (ssh).
/// @param variable  of the environment, null: not set
std::vector<std::string> browser_command(const std::filesystem::path& file,
                                         const std::function<const char*(const char*)>& variable);

/// Starts it in a session of its own and leaves it alone: it outlives this command, and nobody hears what it says.
/// @returns false when it could not be started.
bool start_browser(const std::vector<std::string>& command);

}  // namespace skein::cli
