// The bus that a program's command line asks for.
#pragma once

#include "bus/bus.hpp"
#include "core/scenario.hpp"
#include "process/program.hpp"

namespace skein::bus {

/// @throws InputError for an unknown vendor, for a network interface that this host has not, or for networks of domains
/// that the scenario has not.
std::unique_ptr<Bus> make_bus(const ProgramOptions& options, const Scenario& scenario);

}  // namespace skein::bus
