// Waiting for a fact. Tests that wait use this and no clock of their own (tests/layers holds them to it). A limit only
// ends a test that has failed: it is far longer than anything takes, and where more programs want to run than there are
// cores, it grows with their number.
#pragma once

#include <chrono>
#include <functional>

namespace skein {

/// Longer than any single step takes on an idle machine.
inline constexpr std::chrono::seconds kPatience{120};

/// Polls: for what is not announced. @returns whether `condition` came true in time.
bool eventually(const std::function<bool()>& condition, std::chrono::milliseconds limit = kPatience);

}  // namespace skein
