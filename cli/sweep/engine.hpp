// What flies the units of a sweep: this machine, GNU parallel over ssh, or Slurm. Skein schedules nothing itself.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace skein::cli {

/// A unit as the engine has it.
struct EngineJob {
  std::size_t unit = 0;
  std::string state;  ///< in the engine's words: "RUNNING on node3", "PENDING (Resources)"
};

/// What an engine is to have flown.
struct EngineWork {
  std::vector<std::size_t> units;
  std::set<std::string> not_on;  ///< nodes on which nothing of it may fly, as far as the engine can choose
};

/// What an engine calls while it has units flown.
struct Meanwhile {
  std::function<void()> tell;        ///< now and then
  std::function<EngineWork()> more;  ///< at most once: it has a slot for which no unit is left. May be empty
};

class SweepEngine {
 public:
  virtual ~SweepEngine() = default;

  /// Has these units flown, and returns when it holds none of the sweep any more, whatever came of them: the sweep's
  /// folder tells. Units that it holds already, of an earlier call, are not given to it twice.
  /// @returns false when the user interrupted it, or does not want to wait.
  /// @throws InputError when the engine does not take them, with its own words.
  virtual bool fly(const EngineWork& work, const Meanwhile& meanwhile) = 0;

  /// What it holds, asked from the engine.
  virtual std::vector<EngineJob> jobs() = 0;

  /// Ends what it holds of this sweep, which was planned anew.
  virtual void cancel() {}

  /// Whether units fly on other machines than this one.
  virtual bool has_other_nodes() const = 0;
};

}  // namespace skein::cli
