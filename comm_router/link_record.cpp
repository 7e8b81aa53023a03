#include "comm_router/link_record.hpp"

#include "core/radio_routes.hpp"

namespace skein::router {

LinkRecord::LinkRecord(std::unique_ptr<LinkModel> links, const Scenario& scenario, const std::filesystem::path& folder)
    : links_(std::move(links)), scenario_(scenario), file_(folder / "capture_messages.csv") {}

LinkFate LinkRecord::fate(std::uint64_t k, const RadioRoute& route, Node target, const RadioMessage& message) {
  const LinkFate fate = links_->fate(k, route, target, message);
  const bool spoiled = fate.loss != LinkLoss::none || fate.delay_steps > 0;
  const std::string& uav = scenario_.node_name(route.source);
  if (!spoiled || target != kStationNode || route.ros_topic != captures_topic(uav)) return fate;
  if (!out_.is_open()) {
    const bool is_new = !std::filesystem::exists(file_);
    out_.open(file_, std::ios::app);
    if (is_new) out_ << "step,uav,arrives\n";
  }
  out_ << k << ',' << uav << ',';
  if (fate.loss == LinkLoss::none) out_ << k + 1 + fate.delay_steps;
  out_ << std::endl;  // a router may be killed at any time
  return fate;
}

}  // namespace skein::router
