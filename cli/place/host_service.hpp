// `skein --host`: starts, watches and ends programs of a fleet on this host for a launcher on another one; they
// exchange frames over its standard streams (frames.hpp). When the launcher ends, is cut off or falls silent, this
// process ends all its programs, removes its files, and exits. `skein run --place` starts it, not the user.
// Linux. Threads: one.
#pragma once

#include <filesystem>
#include <string>

namespace skein::cli {

struct HostOptions {};  ///< `skein --host` has no options

/// Serves a launcher on descriptors 0 and 1. @returns the exit code.
int serve_host();

/// A digest that must be the same on all hosts of a fleet: SHA-256 of the binaries of the launcher and of uav_agent.
std::string build_digest(const std::filesystem::path& bin_dir);

/// A text that differs between machines, between boots of a machine, and between network namespaces.
std::string machine_identity();

}  // namespace skein::cli
