// Waits for a condition. Tests that wait use this and no clock of their own (tests/layers checks that). The limit only
// ends a test that has failed: it is far longer than anything takes, and if more programs want to run than there are
// cores, it grows with their number.
#pragma once

#include <chrono>
#include <functional>

namespace skein {

/// Longer than any single step takes on an idle machine.
inline constexpr std::chrono::seconds kPatience{120};

/// Polls `condition`. @returns whether it became true in time.
bool eventually(const std::function<bool()>& condition, std::chrono::milliseconds limit = kPatience);

}  // namespace skein
