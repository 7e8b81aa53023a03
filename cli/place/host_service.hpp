// `skein --host`: this process starts, watches and ends programs of a fleet for a launcher on another host, which talks
// to it over its standard streams (frames.hpp). It is those programs' minder: when the launcher ends, is cut off or
// falls silent, it ends them all, removes what it wrote, and goes. Nobody types this; `skein run --place` does.
// Linux. One thread.
#pragma once

#include <filesystem>
#include <string>

namespace skein::cli {

/// Serves a launcher on descriptors 0 and 1. @returns the exit code.
int serve_host();

/// What must be the same on all hosts of a fleet: SHA-256 of the launcher and of the agent program.
std::string build_digest(const std::filesystem::path& bin_dir);

/// Another one for each machine, each of its starts and each network namespace.
std::string machine_identity();

}  // namespace skein::cli
