// Creates the bus that a program's command line specifies, and lets the program have enough open files for it.
#pragma once

#include <cstddef>

#include "bus/bus.hpp"
#include "core/scenario/scenario.hpp"
#include "process/program.hpp"

namespace skein::bus {

/// Over DDS, raises the limit of open files to what the bus needs, unless the program only checks its input: the run
/// may take place on another host. The launcher does the same for its fleet, but a program may run without a launcher,
/// or on another host.
/// @param domains  how many domains the program joins
/// @throws InputError for an unknown vendor, a network interface that this host does not have, a network for a domain
/// that the scenario does not have, or too low a limit of open files.
std::unique_ptr<Bus> make_bus(const ProgramOptions& options, const Scenario& scenario, std::size_t domains);

}  // namespace skein::bus
