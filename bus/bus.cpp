#include "bus/bus.hpp"

#include <fstream>

#include "bus/cyclonedds/cyclonedds_bus.hpp"
#include "bus/fastdds/fastdds_bus.hpp"
#include "bus/inproc/inproc_bus.hpp"
#include "bus/reach.hpp"
#include "bus/wire.hpp"
#include "core/types.hpp"
#include "process/files/security_files.hpp"

namespace skein::bus {

namespace {

constexpr std::chrono::seconds kAskedIsNew{5};

std::string name_of(int domain) { return domain == kEveryDomain ? "all domains" : "domain " + std::to_string(domain); }

void check_security(const BusConfig& config) {
  if (config.security.empty()) return;
  if (config.vendor == "inproc") throw InputError("security: inproc has none; use cyclonedds or fastdds");
  for (const char* name : security_files::kAll) {
    if (!std::ifstream(config.security / name).good()) {
      throw InputError("--security " + config.security.string() + ": " + name + " cannot be read");
    }
  }
}

}  // namespace

std::unique_ptr<Bus> make_bus(BusConfig config) {
  check_security(config);
  std::vector<std::string> peers;
  for (const auto& [domain, network] : config.networks) {
    check_interface(network, name_of(domain));
    peers.insert(peers.end(), network.peers.begin(), network.peers.end());
  }
  config.asked.addresses = look_up_all(std::move(peers));
  config.asked.at = std::chrono::steady_clock::now();
  if (config.vendor == "cyclonedds") return make_cyclonedds_bus(config);
  if (config.vendor == "fastdds") return make_fastdds_bus(config);
  if (config.vendor == "inproc") return make_inproc_bus(config.run);
  throw InputError("unknown DDS vendor '" + config.vendor + "': it must be cyclonedds, fastdds or inproc");
}

std::vector<std::string> dds_vendors() { return {"cyclonedds", "fastdds"}; }

void check_domain(int domain) {
  if (domain < 0 || domain > kMaxDomain)
    throw InputError("domain " + std::to_string(domain) + " is out of range: it must be 0 to " +
                     std::to_string(kMaxDomain) + ", since its UDP ports begin at 7400 + 250 x domain");
}

DomainNetwork BusConfig::network(int domain) const {
  for (const int key : {domain, kEveryDomain}) {
    if (const auto found = networks.find(key); found != networks.end()) return found->second;
  }
  return {};
}

Reach reach_of(const BusConfig& config, int domain) {
  const bool just_asked = std::chrono::steady_clock::now() - config.asked.at < kAskedIsNew;
  return find_reach(config.network(domain), name_of(domain), config.peers_patience,
                    just_asked ? std::optional(config.asked.addresses) : std::nullopt);
}

}  // namespace skein::bus
