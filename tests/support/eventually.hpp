// Waiting for a fact. Tests that wait use this and no clock of their own (tests/layers holds them to it): a limit only
// ends a test that has failed, so it is far longer than anything takes, on a busy machine too.
#pragma once

#include <chrono>
#include <functional>

namespace skein {

/// Longer than any single step takes beside other test suites and builds.
inline constexpr std::chrono::seconds kPatience{120};

/// Polls: for what is not announced. @returns whether `condition` came true in time.
bool eventually(const std::function<bool()>& condition, std::chrono::milliseconds limit = kPatience);

}  // namespace skein
