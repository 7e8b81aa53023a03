// What the launcher and its programs write and no agent may read: results and scenes hold ground truth. Agents of a
// secured run have user ids of their own when the launcher is root (docs/security.md), and all of them are members of
// one group. A file of that group with no rights for it is closed to them, and as open to everybody else as it was.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace skein {

/// The group of all agents that have user ids of their own. systemd's table of ids has it unused, nor does Debian's
/// policy give it away.
inline constexpr gid_t kAgentsGroup = 61183;

/// Closes a file or a folder, with all below it, to agents. Where its group has other rights than all others, or the
/// file system knows no groups, it is closed to all others instead.
/// Only root's call does anything: any other user's agents are that user. Follows no link.
/// @returns whether it was open to others before, and is closed to agents now.
bool close_to_agents(const std::filesystem::path& path);

}  // namespace skein
