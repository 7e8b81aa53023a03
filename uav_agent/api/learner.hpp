// A planner that is told in each step what to do by a program outside: by Python, which steps the fleet
// (docs/how-to-python.md). It looks first and shows what it sees; the step stands still until it is told; then it
// plans. Both go by a block of memory that the planner lays out and the program outside shares.   Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/block_layout.hpp"
#include "core/ids.hpp"

namespace skein::agent {

struct PlannerInput;

/// What such a planner is to whoever steps it.
class Learner {
 public:
  Learner() = default;
  Learner(const Learner&) = delete;
  Learner& operator=(const Learner&) = delete;
  virtual ~Learner() = default;

  /// Lays out what it shows and what it is told. The same each time, so that a program that is started again finds the
  /// block of the one before. @param prefix  of all names.
  virtual void lay_out(BlockLayout& layout, const std::string& prefix) = 0;
  /// From now on it uses this block, which must outlive it. After lay_out().
  virtual void use(std::byte* block) = 0;
  /// Shows what it knows. Before plan(), with the same input; not in every step.
  virtual void look(const PlannerInput& input) = 0;
};

/// Whoever steps the learners of a process.
class LearnerDesk {
 public:
  LearnerDesk() = default;
  LearnerDesk(const LearnerDesk&) = delete;
  LearnerDesk& operator=(const LearnerDesk&) = delete;
  virtual ~LearnerDesk() = default;

  /// A learner takes its place; its program may have been started again. @param learner  lives as long as its program.
  virtual void enter(const std::string& uav, Learner& learner) = 0;
  /// Whether learners are to look in step k, and then to wait.
  virtual bool looks(std::uint64_t k) const = 0;
  /// Whether they have been told for step k.
  virtual bool told(std::uint64_t k) const = 0;
};

}  // namespace skein::agent
