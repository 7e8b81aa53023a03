// Shares a program's turn with other threads: their output and their crashes count as those of the program.
#pragma once

#include "core/for_each.hpp"
#include "process/host/workers.hpp"

namespace skein::one_process {

/// @returns a function that runs a loop in parallel, for a program that has its turn alone.
/// @param workers  must outlive the result.
ForEach shared_turn(Workers& workers);

}  // namespace skein::one_process
