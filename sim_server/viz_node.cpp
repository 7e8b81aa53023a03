#include "sim_server/viz_node.hpp"

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "sim_server/viz/frames.hpp"
#include "sim_server/viz/markers.hpp"

namespace skein::sim {
namespace {

constexpr Tick kVizPeriod = kTicksPerSecond / 10, kMapPeriod = kTicksPerSecond;

std::unique_ptr<bus::Writer> viz_writer(bus::Participant& world, const topics::TopicInfo& topic) {
  return world.create_writer(bus::spec(topics::wire(topic)));
}

void show(bus::Writer& writer, auto&& make) {
  if (writer.has_readers()) writer.write(encode(make()));
}

template <class Latched, class Make>
void show_if_stale(Latched& topic, Make&& make) {
  if (!topic.stale || !topic.writer->has_readers()) return;
  topic.writer->write(encode(make()));
  topic.stale = false;
}

}  // namespace

VizNode::VizNode(const Scenario& scenario, const Simulation& simulation, bus::Participant& world)
    : scenario_(scenario),
      simulation_(simulation),
      structure_{viz_writer(world, topics::kVizStructure)},
      boxes_{viz_writer(world, topics::kVizBoxes)},
      fixed_frames_{viz_writer(world, topics::kTfStatic)},
      map_{viz_writer(world, topics::kVizMap)},
      links_(viz_writer(world, topics::kVizLinks)),
      frusta_(viz_writer(world, topics::kVizFrusta)),
      fleet_(viz_writer(world, topics::kVizFleet)),
      paths_(viz_writer(world, topics::kVizPaths)),
      frames_(viz_writer(world, topics::kTf)),
      clock_(viz_writer(world, topics::kClock)),
      trails_(scenario.fleet.size()),
      seen_(KeyFrameSelector::kCell) {}

// The node records paths and map even while no viewer subscribes, so that viewers that subscribe later get them, too.
// This costs little, because key frames are few and already thinned out.
void VizNode::publish() {
  paths_stale_ |= trails_.add(simulation_.tick(), simulation_.uavs());
  for (const KeyFrameEvent& event : simulation_.events().key_frames) map_.stale |= seen_.add(event.key_frame.points_W);
  if (simulation_.tick() < due_) return;
  due_ = simulation_.tick() + kVizPeriod;
  publish_static();
  publish_moving();
}

void VizNode::publish_static() {
  const Scene& scene = simulation_.scene();
  show_if_stale(fixed_frames_, [&] { return viz::fixed_frames(scenario_); });
  show_if_stale(structure_, [&] { return viz::structure_marker(scene.mesh); });
  show_if_stale(boxes_, [&] { return viz::box_marker(scene.boxes); });
  if (simulation_.tick() < map_due_) return;
  map_due_ = simulation_.tick() + kMapPeriod;
  show_if_stale(map_, [&] { return to_cloud(simulation_.tick(), seen_.points()); });
}

void VizNode::publish_moving() {
  const Tick tick = simulation_.tick();
  const std::span<const UavView> uavs = simulation_.uavs();
  show(*clock_, [&] {
    msg::Clock clock;
    clock.clock(to_time(tick));
    return clock;
  });
  show(*frames_, [&] { return viz::moving_frames(tick, scenario_, uavs); });
  show(*fleet_, [&] { return viz::fleet_markers(tick, scenario_, uavs); });
  show(*frusta_, [&] { return viz::frustum_markers(tick, scenario_, uavs); });
  show(*links_, [&] { return viz::link_marker(tick, scenario_, uavs, simulation_.open_links()); });
  if (!paths_stale_) return;
  show(*paths_, [&] { return viz::path_markers(tick, scenario_, trails_); });
  paths_stale_ = false;
}

}  // namespace skein::sim
