// Standard output of a program: output that is lost, for example on a full disk, must not pass for a success.
#pragma once

#include <string>

namespace skein::cli {

/// Flushes std::cout. @returns an error message if some output was lost; empty: all of it has arrived, or the reader of
/// a pipe has left without reading all, as `head` does.
std::string lost_output();

}  // namespace skein::cli
