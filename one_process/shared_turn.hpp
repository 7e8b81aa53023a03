// Shares a program's turn with other threads: their output and their crashes count as those of the program.
#pragma once

#include "core/for_each.hpp"
#include "process/host/workers.hpp"

namespace skein::one_process {

/// Runs loops of a program that has its turn alone in parallel. @param workers  must outlive the result.
ForEach shared_turn(Workers& workers);

}  // namespace skein::one_process
