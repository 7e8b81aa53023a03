// Turns the errors of a command into messages and an exit code.
#pragma once

#include <functional>

#include "cli/console.hpp"

namespace skein::cli {

/// Calls work(). If it throws, prints the error on console.err.
/// @returns its exit code; if it throws, kExitBadInput for a mistake of the user (InputError, a wrong path), else
///   kExitProcessFailed. @throws Interrupted
int tell_errors(const Console& console, const std::function<int()>& work);

}  // namespace skein::cli
