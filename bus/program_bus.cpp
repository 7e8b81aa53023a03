#include "bus/program_bus.hpp"

#include <algorithm>

#include "core/topics.hpp"

namespace skein::bus {

std::unique_ptr<Bus> make_bus(const ProgramOptions& options, const Scenario& scenario) {
  BusConfig config{.vendor = options.dds, .lease_s = options.lease_s, .security = options.security, .run = options.run};
  if (options.network) {
    const NetworkConfig network = read_network(*options.network);
    const std::vector<std::string> names = domain_names(scenario);
    network.check_names(names);
    config.networks[kEveryDomain] = network.usual;
    for (const auto& [name, own] : network.domains) {
      config.networks[options.domain + static_cast<int>(std::ranges::find(names, name) - names.begin())] = own;
    }
  }
  return make_bus(config);
}

}  // namespace skein::bus
