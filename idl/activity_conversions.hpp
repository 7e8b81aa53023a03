// Converts a program's activity to its message and back. Pure; any thread.
#pragma once

#include "core/messages/activity.hpp"
#include "idl/type_names.hpp"

namespace skein {

msg::Activity to_activity(Tick tick, const Activity& activity);
/// Accepts messages of any program: each text becomes one cell of a table (no commas, no control characters, 160 bytes
/// at most), a goal with a number that is not finite becomes none, and other such numbers become 0.
Activity from_activity(const msg::Activity& message);

}  // namespace skein
