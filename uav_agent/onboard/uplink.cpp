#include "uav_agent/onboard/uplink.hpp"

#include <algorithm>
#include <iterator>

namespace skein::agent {

bool Uplink::is_acknowledged(std::uint64_t capture) const {
  auto after = acknowledged_.upper_bound(capture);
  return after != acknowledged_.begin() && std::prev(after)->second >= capture;
}

void Uplink::take(const std::vector<HandedOut>& reports) {
  for (const HandedOut& report : reports) {
    if (is_acknowledged(report.capture)) continue;
    held_.try_emplace(report.capture, Held{report.bytes});
  }
}

void Uplink::acknowledge(const std::vector<std::uint64_t>& captures) {
  for (const std::uint64_t capture : captures) {
    held_.erase(capture);
    if (is_acknowledged(capture)) continue;
    std::uint64_t first = capture, last = capture;
    const auto after = acknowledged_.upper_bound(capture);
    if (after != acknowledged_.end() && after->first - capture == 1) {
      last = after->second;
      acknowledged_.erase(after);
    }
    if (auto next = acknowledged_.upper_bound(capture); next != acknowledged_.begin()) {
      const auto before = std::prev(next);
      if (before->second + 1 == capture) {
        first = before->first;
        acknowledged_.erase(before);
      }
    }
    acknowledged_[first] = last;
  }
}

std::vector<std::uint64_t> Uplink::send(std::uint64_t k, bool station_linked) {
  std::vector<std::uint64_t> out;
  if (!station_linked) return out;
  std::size_t bytes = 0;
  for (auto& [capture, held] : held_) {
    if (held.sent && k < held.sent_at + config_.resend_after_steps) continue;
    if (!out.empty() && bytes + held.bytes > config_.max_bytes_per_step) break;
    bytes += held.bytes;
    held.sent = true;
    held.sent_at = k;
    out.push_back(capture);
  }
  return out;
}

}  // namespace skein::agent
