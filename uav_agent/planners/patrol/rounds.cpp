#include "uav_agent/planners/patrol/rounds.hpp"

#include <algorithm>

namespace skein::agent {

void PatrolRounds::begin() {
  ++number_;
  if (number_ > 0) {
    std::reverse(share_.tour.begin(), share_.tour.end());
    for (Visit& visit : share_.tour) visit.reversed = !visit.reversed;
  }
  for (std::size_t i = 0; i < share_.tour.size(); ++i) to_do_.push_back(i);
}

void PatrolRounds::take_next() {
  current_ = to_do_.front();
  to_do_.pop_front();
}

}  // namespace skein::agent
