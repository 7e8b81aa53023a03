#include "comm_router/recording_node.hpp"

#include "idl/conversions.hpp"

namespace skein::router {

void RecordingNode::add(const StepBatch& batch, const std::vector<RadioRoute>& routes, const GatedStep& gated) {
  const Tick tick = static_cast<Tick>(batch.k) * scenario_.exchange_ticks();
  recorder_.set_time(tick);
  for (const SentMessage& message : batch.messages) {
    const RadioRoute& route = routes[message.route];
    recorder_.add(recording::recorded_topic(scenario_.node_name(route.source), route.ros_topic), route.type,
                  *message.payload, message.sequence);
  }
  if (gated.deliveries.empty()) return;
  msg::Arrivals arrivals;
  arrivals.stamp(to_time(tick));
  arrivals.step(batch.k);
  for (const Delivery& delivery : gated.deliveries) {
    const RadioRoute& route = routes[delivery.route];
    msg::Arrival arrival;
    arrival.source(scenario_.node_name(route.source));
    arrival.target(scenario_.node_name(route.targets[delivery.target].node));
    arrival.topic(route.ros_topic);
    arrival.number(delivery.sequence);
    arrivals.arrivals().push_back(std::move(arrival));
  }
  recorder_.add(kArrivalsTopic, arrivals);
}

}  // namespace skein::router
