#include "bus/program_bus.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>

#include "core/text/suggestion.hpp"
#include "core/topics.hpp"
#include "process/host/open_files.hpp"

namespace skein::bus {

std::unique_ptr<Bus> make_bus(const ProgramOptions& options, const Scenario& scenario, std::size_t domains) {
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
  if (!options.check_only && std::ranges::count(dds_vendors(), options.dds) > 0) {
    const std::string warning = provide_open_files(
        "this program, which joins " + counted(static_cast<std::size_t>(domains), "DDS domain") + ",",
        open_files_over_dds(domains, options.dds == "fastdds"));
    if (!warning.empty() && !options.has_launcher()) spdlog::warn("{}", warning);  // a launcher has warned already
  }
  return make_bus(config);
}

}  // namespace skein::bus
