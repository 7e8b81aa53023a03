#include "sim_server/gcs_node.hpp"

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "idl/conversions.hpp"
#include "sim_server/uav_node.hpp"

namespace skein::sim {

GcsNode::GcsNode(const Scenario& scenario, const Simulation& simulation, bus::LockstepServer& server,
                 bus::LockstepServer::DomainIndex domain, bus::Participant& world)
    : scenario_(scenario),
      simulation_(simulation),
      uavs_(scenario.uav_names()),
      boxes_(server.writer(domain, bus::spec(topics::bounding_boxes()))),
      clock_(server.writer(domain, bus::spec(topics::clock()))),
      remained_(server.writer(domain, bus::spec(topics::mission_duration_remained(bus::kGcsName)))),
      neighbours_(server.writer(domain, bus::spec(topics::neighbour_odometry(bus::kGcsName)))),
      ledger_(world, bus::spec(topics::ledger())) {}

void GcsNode::publish() {
  const Tick tick = simulation_.tick();
  if (boxes_.count() == 0) boxes_.write(to_box_vertices(tick, simulation_.scene().boxes));
  msg::Clock clock;
  clock.clock(to_time(tick));
  clock_.write(clock);
  if (simulation_.mission().start_tick()) remained_.write(to_duration(simulation_.mission().remaining_s(tick)));
  neighbours_.write(neighbour_cloud(simulation_, scenario_, kStationNode));
}

// The first message is sent even if the ledger has no entries: it has the interest points.
void GcsNode::publish_ledger(RunId run) {
  const std::vector<LedgerEntry>& entries = simulation_.referee().ledger();
  const std::size_t begin = simulation_.events().ledger_begin;
  if (begin == entries.size() && ledger_.count() > 0) return;
  auto message = bus::message_of<msg::Ledger>(run);
  const std::vector<InterestPoint>& points = simulation_.scene().points;
  message.interest_points(static_cast<std::uint32_t>(points.size()));
  if (ledger_.count() == 0) {
    for (const InterestPoint& point : points) message.points().push_back(to_message(point));
  }
  for (std::size_t i = begin; i < entries.size(); ++i) message.entries().push_back(to_message(entries[i], uavs_));
  ledger_.begin_step();
  ledger_.write(message);
}

}  // namespace skein::sim
