// A bus within one process, without threads: write() calls the readers' callbacks before it returns, in the order in
// which the readers were created. Threads may write side by side; a callback writes in the domain of its sample only.
// Deterministic; for tests and for whole fleets in one process.
// All participants of the process that joined the same domain meet, whichever Bus object they come from.
// Not covered by `depth`: a reader's queue, since there is none.
#pragma once

#include <memory>

#include "bus/bus.hpp"

namespace skein::bus {

std::unique_ptr<Bus> make_inproc_bus(RunId run);

}  // namespace skein::bus
