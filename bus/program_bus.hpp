// The bus that a program's command line asks for.
#pragma once

#include "bus/bus.hpp"
#include "process/program.hpp"

namespace skein::bus {

/// @throws InputError for an unknown vendor, or for a network interface that this host has not.
inline std::unique_ptr<Bus> make_bus(const ProgramOptions& options) {
  return make_bus(BusConfig{.vendor = options.dds,
                            .loopback_only = !options.network,
                            .interface = options.network.value_or("all") == "all" ? "" : *options.network,
                            .lease_s = options.lease_s,
                            .security = options.security,
                            .run = options.run});
}

}  // namespace skein::bus
