// Interface to the engine that schedules and runs the units of a sweep: this machine, GNU parallel over ssh, or Slurm.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace skein::cli {

/// A unit that the engine has accepted and not finished.
struct EngineJob {
  std::size_t unit = 0;
  std::string state;  ///< in the engine's words: "RUNNING on node3", "PENDING (Resources)"
};

/// Units for an engine.
struct EngineWork {
  std::vector<std::size_t> units;
  std::set<std::string> not_on;  ///< nodes that must not fly these units, if the engine can exclude nodes
};

/// Functions that an engine calls while its units fly.
struct Meanwhile {
  std::function<void()> tell;        ///< reports progress; called now and then
  std::function<EngineWork()> more;  ///< called at most once, when a slot is idle and no unit is left for it;
                                     ///< the work that it returns may be empty
};

class SweepEngine {
 public:
  virtual ~SweepEngine() = default;

  /// Lets the engine run these units, and returns when it holds no unit any more, whether they succeeded or not: their
  /// results are in the sweep's folder. Does not submit units again that it still holds from an earlier call.
  /// @returns false if the user interrupted it, or does not want to wait.
  /// @throws InputError if the engine rejects the units, with the engine's own message.
  virtual bool fly(const EngineWork& work, const Meanwhile& meanwhile) = 0;

  /// The units that the engine holds; always empty for engines other than Slurm.
  virtual std::vector<EngineJob> jobs() = 0;

  /// Cancels all units of the sweep that the engine holds, because a new sweep replaces it.
  virtual void cancel() {}

  /// Whether units can fly on machines other than this one.
  virtual bool has_other_nodes() const = 0;
  /// Whether the engine gave up units with `not_on`, because no other node is left.
  virtual bool lacks_nodes() const { return false; }
};

}  // namespace skein::cli
