// A domain of Cyclone DDS in this process: its configuration and its lifetime.
#pragma once

#include <dds/dds.h>

#include <string>

#include "bus/bus.hpp"
#include "bus/reach.hpp"

namespace skein::bus::cyclonedds {

/// Cyclone's configuration (XML) for a domain.
std::string domain_configuration(const BusConfig& config, const Reach& reach);

/// @throws std::runtime_error "what: Cyclone's reason" when `result` is negative; @returns it otherwise
dds_return_t check(dds_return_t result, const std::string& what);

/// This process's membership in a domain: the domain lives as long as any of its memberships. From any thread.
class Domain {
 public:
  /// @throws std::runtime_error when Cyclone cannot create it
  Domain(int id, const BusConfig& config, const Reach& reach);
  ~Domain();
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;

  dds_entity_t entity() const { return entity_; }

 private:
  int id_;
  dds_entity_t entity_ = 0;
};

}  // namespace skein::bus::cyclonedds
