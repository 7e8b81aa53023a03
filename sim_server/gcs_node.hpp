// Publishes the server's data for the ground station: the topics of the GCS domain and, in the world domain, the
// referee's ledger.   Frame: W.   Units: m, s.   Threads: one.
#pragma once

#include "bus/bus.hpp"
#include "bus/lockstep/server.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class GcsNode {
 public:
  /// @param world  the server's participant in the world domain. All references must outlive this.
  GcsNode(const Scenario& scenario, const Simulation& simulation, bus::LockstepServer& server,
          bus::LockstepServer::DomainIndex domain, bus::Participant& world);

  /// Publishes the samples of this step in the GCS domain.
  void publish();
  /// Publishes in the world domain the ledger entries that this step adds. The first message has the interest points.
  void publish_ledger(RunId run);

 private:
  const Scenario& scenario_;
  const Simulation& simulation_;
  const std::vector<std::string> uavs_;
  bus::CountedWriter &boxes_, &clock_, &remained_, &neighbours_;
  bus::CountedWriter ledger_;
};

}  // namespace skein::sim
