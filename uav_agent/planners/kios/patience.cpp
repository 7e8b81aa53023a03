#include "uav_agent/planners/kios/patience.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kFliesMps = 0.3;  ///< an explorer faster than this flies; chosen

}  // namespace

bool KiosPatience::is_over(const PlannerInput& in, const KiosConfig& config) {
  bool any_maps = false, done = false, busy = false;
  for (const Peer& peer : in.peers.all()) {
    const auto word = talk_.word(peer.uav);
    if (agent_.fleet[peer.uav].role != Role::explorer) {
      done |= came_back_ && word && word->stop != KiosTalk::kNoStop;
      continue;
    }
    any_maps = true;
    if (peer.visible && peer.v_W.norm() > kFliesMps) seen_flying_ = in.tick;
    done |= word && !word->mapping;
    busy |= word && word->mapping && peer.visible;
  }
  if (!any_maps || (done && !busy)) return true;
  const double silent_s = seconds(in.tick - std::max(seen_flying_, since_)), waited_s = seconds(in.tick - since_);
  return silent_s > *config.silence_s || waited_s > *config.wait_s;
}

}  // namespace skein::agent
