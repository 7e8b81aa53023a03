// A bus within one process, without threads: write() calls the readers' callbacks before it returns, in the order in
// which the readers were created. Several threads may write at the same time; a callback may write only in the domain
// of its sample. Deterministic; for tests and for whole fleets in one process.
// All participants of the process that joined the same domain discover each other, also those of different Bus objects.
// Readers have no queue, so `depth` limits only the history of latched writers.
#pragma once

#include <memory>

#include "bus/bus.hpp"

namespace skein::bus {

std::unique_ptr<Bus> make_inproc_bus(RunId run);

}  // namespace skein::bus
