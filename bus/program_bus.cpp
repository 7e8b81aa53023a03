#include "bus/program_bus.hpp"

#include "core/topics.hpp"

namespace skein::bus {

std::unique_ptr<Bus> make_bus(const ProgramOptions& options, const Scenario& scenario) {
  BusConfig config{.vendor = options.dds, .lease_s = options.lease_s, .security = options.security, .run = options.run};
  if (options.network) {
    const NetworkConfig network = read_network(*options.network);
    network.check_names(domain_names(scenario));
    config.networks[kEveryDomain] = network.usual;
    const std::vector<std::string> names = domain_names(scenario);
    for (std::size_t i = 0; i < names.size(); ++i) {
      config.networks[options.domain + static_cast<int>(i)] = network.of(names[i]);
    }
  }
  return make_bus(config);
}

}  // namespace skein::bus
