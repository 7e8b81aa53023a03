// What a program says of what it does, to and from its message. Pure; any thread.
#pragma once

#include "core/activity.hpp"
#include "idl/type_names.hpp"

namespace skein {

msg::Activity to_activity(Tick tick, const Activity& activity);
/// Of whatever program: texts become one line of a table each (no commas, no control characters, 160 bytes at most),
/// a goal that no numbers describe becomes none, other such numbers 0.
Activity from_activity(const msg::Activity& message);

}  // namespace skein
