#include "comm_router/link_record.hpp"

#include <system_error>

#include "core/radio/radio_routes.hpp"
#include "results/run_folder.hpp"
#include "results/run_tables.hpp"

namespace skein::router {

LinkRecord::LinkRecord(std::unique_ptr<LinkModel> links, const Scenario& scenario, const std::filesystem::path& folder,
                       std::vector<std::string>& unwritten)
    : links_(std::move(links)),
      scenario_(scenario),
      file_(folder / run_folder::kCaptureMessages),
      unwritten_(unwritten) {}

LinkFate LinkRecord::fate(std::uint64_t k, const RadioRoute& route, Node target, const SentMessage& message) {
  const LinkFate fate = links_->fate(k, route, target, message);
  const bool spoiled = fate.loss != LinkLoss::none || fate.delay_steps > 0;
  const std::string& uav = scenario_.node_name(route.source);
  if (!spoiled || target != kStationNode || route.ros_topic != captures_topic(uav)) return fate;
  std::string line = std::to_string(k) + "," + uav + ",";
  if (fate.loss == LinkLoss::none) line += std::to_string(k + 1 + fate.delay_steps);
  write(line + "\n");
  return fate;
}

void LinkRecord::write(const std::string& line) try {
  if (refused_) return;
  if (!out_) {
    const bool is_new = !std::filesystem::exists(file_);
    out_.emplace(file_, StreamFile::Mode::append);
    if (is_new) *out_ << run_tables::kCaptureMessageColumns << "\n";
  }
  *out_ << line;
  out_->flush();  // a router may be killed at any time
  refused_ = !out_->write_error().empty();
  if (refused_) unwritten_.push_back(out_->write_error());
} catch (const std::system_error& error) {
  refused_ = true;
  unwritten_.push_back(error.what());
}

}  // namespace skein::router
