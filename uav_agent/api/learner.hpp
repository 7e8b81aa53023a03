// A learner is a planner that an external program controls: Python code that steps the fleet with skein.Fleet
// (docs/how-to-python.md). In a step of that program, the learner first writes its observation into a block of memory
// that it shares with the program. The simulation waits until the program has written its orders into the block. Then
// the learner plans by these orders. The learner defines the layout of the block.   Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/ids.hpp"
#include "core/planners/block_layout.hpp"

namespace skein::agent {

struct PlannerInput;

/// The learner, as the program that steps the fleet sees it.
class Learner {
 public:
  Learner() = default;
  Learner(const Learner&) = delete;
  Learner& operator=(const Learner&) = delete;
  virtual ~Learner() = default;

  /// Adds the arrays of observations and orders to the layout: the same arrays at each call.
  /// @param prefix  of the names of all arrays.
  virtual void lay_out(BlockLayout& layout, const std::string& prefix) = 0;
  /// From now on, the learner uses this block. Call it after lay_out(). @param block  must outlive the learner.
  virtual void use(std::byte* block) = 0;
  /// Writes the observation into the block. Called before plan(), with the same input, in the steps in which
  /// LearnerDesk::looks() is true.
  virtual void look(const PlannerInput& input) = 0;
};

/// The program that steps the fleet, as the agents of the learners see it.
class LearnerDesk {
 public:
  LearnerDesk() = default;
  LearnerDesk(const LearnerDesk&) = delete;
  LearnerDesk& operator=(const LearnerDesk&) = delete;
  virtual ~LearnerDesk() = default;

  /// Registers a learner when its agent starts. @param learner  must live as long as its agent.
  /// @throws std::logic_error once the learners use a block: an agent cannot be restarted then.
  virtual void enter(const std::string& uav, Learner& learner) = 0;
  /// Whether the learners must write their observation in step k, and then wait for orders.
  virtual bool looks(std::uint64_t k) const = 0;
  /// Whether the orders for step k are in the block.
  virtual bool told(std::uint64_t k) const = 0;
};

}  // namespace skein::agent
