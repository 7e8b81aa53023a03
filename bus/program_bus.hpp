// Creates the bus that a program's command line specifies.
#pragma once

#include "bus/bus.hpp"
#include "core/scenario.hpp"
#include "process/program.hpp"

namespace skein::bus {

/// @throws InputError for an unknown vendor, a network interface that this host does not have, or a network for a
/// domain that the scenario does not have.
std::unique_ptr<Bus> make_bus(const ProgramOptions& options, const Scenario& scenario);

}  // namespace skein::bus
