// Hides files that contain ground truth (results, scenes) from agents. If the launcher of a secured run is root, each
// agent has a user id of its own (docs/security.md), and all these ids are members of one group. A file that belongs to
// this group, and gives it no permissions, is closed to agents; for all other users nothing changes.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace skein {

/// The group of all agents with user ids of their own. Neither systemd's table of ids nor Debian's policy assigns it.
inline constexpr gid_t kAgentsGroup = 61183;

/// Closes a file, or a folder and so its contents, to agents. If the permissions of its group differ from those of
/// others, or its group cannot be changed, it loses its permissions for others instead.
/// Has an effect only for root: agents of any other user run as that same user. Does not follow symbolic links.
/// @returns true if the file was open to others before, and is now closed to agents.
bool close_to_agents(const std::filesystem::path& path);

}  // namespace skein
