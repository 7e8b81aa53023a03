// What the server writes for the ground station's side: the GCS domain's topics, and the referee's ledger, which
// reaches the station over the world's domain.
#pragma once

#include "bus/bus.hpp"
#include "bus/lockstep/server.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class GcsNode {
 public:
  /// @param world  of the server; it and the references must outlive this.
  GcsNode(const Scenario& scenario, const Simulation& simulation, bus::LockstepServer& server,
          bus::LockstepServer::DomainIndex domain, bus::Participant& world);

  /// All of this step in the GCS domain.
  void publish();
  /// What this step adds to the ledger, in the world domain.
  void publish_ledger(RunId run);

 private:
  const Scenario& scenario_;
  const Simulation& simulation_;
  const std::vector<std::string> uavs_;
  bus::CountedWriter &boxes_, &clock_, &remained_, &neighbours_;
  bus::CountedWriter ledger_;
};

}  // namespace skein::sim
