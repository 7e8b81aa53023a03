// A program's turn, shared with other threads: what they do of it is that program's doing.
#pragma once

#include "core/for_each.hpp"
#include "process/host/workers.hpp"

namespace skein::one_process {

/// For a program that has its turn alone. @param workers  must outlive it.
ForEach shared_turn(Workers& workers);

}  // namespace skein::one_process
