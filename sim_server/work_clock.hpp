// Lets the server measure where its time goes, without a clock in the simulation: the simulation announces when a piece
// of work begins and ends, and a WorkClock measures the time between.   Threads: one.
#pragma once

#include <cstddef>

namespace skein::sim {

enum class Work {
  simulation,  ///< all of Simulation::advance(): includes lidar, camera and links
  lidar,       ///< the scans of one tick
  camera,      ///< the exposures of one tick
  links,       ///< the radio matrix of one step
  recording,   ///< digest and files of one step, outside the simulation
};
inline constexpr int kWorkKinds = 5;

class WorkClock {
 public:
  virtual ~WorkClock() = default;
  virtual void begin(Work work) = 0;
  /// @param pieces  how many pieces of this kind were done: scans, exposures.
  virtual void end(Work work, std::size_t pieces) = 0;
};

/// Announces work from its construction to its destruction. @param clock  may be null. @param pieces  for end().
class WorkSection {
 public:
  WorkSection(WorkClock* clock, Work work, std::size_t pieces = 1) : clock_(clock), work_(work), pieces_(pieces) {
    if (clock_) clock_->begin(work_);
  }
  ~WorkSection() {
    if (clock_) clock_->end(work_, pieces_);
  }
  WorkSection(const WorkSection&) = delete;
  WorkSection& operator=(const WorkSection&) = delete;

 private:
  WorkClock* const clock_;
  const Work work_;
  const std::size_t pieces_;
};

}  // namespace skein::sim
