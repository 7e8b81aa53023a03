// For tests: nodes that simulate flights, and an engine that runs several units on them at once, one step at a time, in
// random order. It kills workers and the controller between any two steps, runs units twice and forgets units; disks of
// nodes fill up. The folder, fly_unit() and the controller are the real ones.
#pragma once

#include <atomic>
#include <fstream>
#include <memory>
#include <semaphore>
#include <sstream>
#include <thread>

#include "cli/study/flights.hpp"
#include "cli/sweep/controller.hpp"
#include "core/math/random_stream.hpp"
#include "host/preflight.hpp"
#include "results/run_folder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::cli {

/// Thrown to simulate SIGKILL; the code under test must not catch it.
struct Killed {};

/// A node, and its faults.
struct MadeUpNode {
  std::string name;
  bool other_arithmetic = false;  ///< all digests differ, also that of the reference flight
  bool odd_once_proved = false;   ///< digests of all flights but the reference flight differ
  bool other_build = false;
  double disk_fills = 0.0;  ///< probability that the disk is full at a flight
  bool sick = false;        ///< the disk is full: from then on every flight fails
};

inline constexpr const char* kMadeUpProblem = "skein run ended with exit code 3: uav_agent-jurong crashed";

class MadeUpWorld {
 public:
  MadeUpWorld(std::uint64_t seed, std::size_t flights) : draw(seed, "sweep test", 0), flights_(flights) {}

  std::filesystem::path study() const { return scratch_.path() / "study"; }

  /// The sweep's folder. Its files are never flushed, because the tests simulate no power failures.
  SweepFolder folder() const {
    SweepFolder folder(study());
    folder.never_flush();
    return folder;
  }

  SweepFlight flight(std::size_t index) const {
    RunOptions run;
    run.seed = index;
    return {
        index, study() / "flights" / ("seed-" + std::to_string(index)), run, {{"programs", build}, {"seed", index}}};
  }
  SweepPlan plan(std::size_t unit_flights) const {
    SweepPlan plan{flights_,
                   [this](std::size_t index) { return flight(index); },
                   {flight(kReference)},
                   [this, unit_flights](double) {
                     const std::size_t head = flights_ * 2 / 3 / unit_flights * unit_flights;
                     return UnitSizes{flights_, unit_flights, flights_ - head, (unit_flights + 1) / 2};
                   },
                   {"compare"},
                   scratch_.path()};
    plan.references.front().dir = study() / "reference";
    return plan;
  }
  std::string digest(std::size_t index) const { return build + "/" + std::to_string(index); }

  /// The node as the code under test sees it. @param step  called before and after a flight writes its result
  SweepNode node(MadeUpNode& of, const std::function<void()>& step) {
    SweepNode node{of.name, "boot", "cpu", {}, {}, {}, {}};
    node.fly = [this, &of, step](const SweepFlight& flight, const std::filesystem::path& out) {
      step();
      if (of.sick || draw.uniform() < of.disk_fills) {
        of.sick = of.disk_fills > 0.0;
        std::ofstream(out / run_folder::kResult) << "{\"status\": \"comp";  // cut off
        return ExitStatus{.code = 3};
      }
      const bool odd = of.other_arithmetic || (of.odd_once_proved && flight.index != kReference);
      const Json result = {{"status", "completed"}, {"digest", digest(flight.index) + (odd ? "?" : "")}};
      std::ofstream(out / run_folder::kResult) << result.dump();
      step();
      return ExitStatus{.code = fails(flight.index) ? 3 : 0};
    };
    node.unlike = [&of](const SweepFlight&) {
      return of.other_build ? "the programs here are not of the build that flies the study" : "";
    };
    node.figures = [](const Json& result) { return Json{{"digest", result["digest"]}}; };
    node.reason = [](const std::filesystem::path&, const ExitStatus&) { return kMadeUpProblem; };
    return node;
  }

  /// Whether a flight fails on every node.
  bool fails(std::size_t index) const { return failing.contains(index); }

  static constexpr std::size_t kReference = 1'000'000;
  RandomStream draw;
  std::string build = "build 1";
  std::set<std::size_t> failing;

 private:
  const std::size_t flights_;
  ScratchFolder scratch_;
};

/// Runs a unit on a node, in a thread that advances one step per run_a_step().
class MadeUpWorker {
 public:
  MadeUpWorker(MadeUpWorld& world, MadeUpNode& node, std::size_t unit) : unit_(unit) {
    thread_ = std::thread([this, &world, &node] {
      go_.acquire();
      try {
        SweepFolder folder = world.folder();
        const auto step = [this] { pause(); };
        folder.on_step(step);
        if (!killed_) fly_unit(folder, unit_, world.node(node, step), said_);
      } catch (const Killed&) {
      } catch (const std::exception& error) {
        said_ << error.what();
      }
      over_ = true;
      back_.release();
    });
  }
  ~MadeUpWorker() {
    kill();
    thread_.join();
  }
  MadeUpWorker(const MadeUpWorker&) = delete;
  MadeUpWorker& operator=(const MadeUpWorker&) = delete;

  /// Lets the unit continue to its next step. @returns false when the unit is over.
  bool run_a_step() {
    if (!over_) {
      go_.release();
      back_.acquire();
    }
    return !over_;
  }
  void kill() {
    killed_ = true;
    while (run_a_step()) {
    }
  }
  std::size_t unit() const { return unit_; }
  std::string said() const { return said_.str(); }

 private:
  void pause() {
    back_.release();
    go_.acquire();
    if (killed_) throw Killed{};
  }

  const std::size_t unit_;
  std::binary_semaphore go_{0}, back_{0};
  std::atomic<bool> over_ = false, killed_ = false;
  std::ostringstream said_;
  std::thread thread_;
};

/// The probability of each fault of the engine at a step, and the number of units that it runs at once.
struct EngineManners {
  double kills_worker = 0.0, kills_controller = 0.0, flies_twice = 0.0, forgets = 0.0;
  std::size_t at_once = 4;
};

class MadeUpEngine : public SweepEngine {
 public:
  MadeUpEngine(MadeUpWorld& world, std::vector<MadeUpNode>& nodes) : world_(world), nodes_(nodes) {}

  bool fly(const EngineWork& work, const Meanwhile& meanwhile) override {
    ++rounds;
    std::vector<std::size_t> waiting;
    std::set<std::string> not_on = work.not_on;
    bool asks = asks_for_more;
    for (const std::size_t unit : work.units) {
      const bool held = std::ranges::any_of(workers_, [&](const auto& worker) { return worker->unit() == unit; });
      if (!held && !drawn(manners.forgets)) waiting.push_back(unit);
      if (drawn(manners.flies_twice)) waiting.push_back(unit);
    }
    while (!waiting.empty() || !workers_.empty()) {
      if (drawn(manners.kills_controller)) throw Killed{};
      if (asks && waiting.empty() && drawn(0.3)) {
        asks = false;
        const EngineWork more = meanwhile.more();
        waiting = more.units;
        not_on = more.not_on;
      }
      if (!waiting.empty() && (workers_.empty() || (workers_.size() < manners.at_once && drawn(0.3)))) {
        start(take(waiting), not_on);
        continue;
      }
      const std::size_t which = place(workers_.size());
      if (drawn(manners.kills_worker)) workers_[which]->kill();
      if (workers_[which]->run_a_step()) continue;
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(which));
      meanwhile.tell();
    }
    return true;
  }
  std::vector<EngineJob> jobs() override { return {}; }
  bool has_other_nodes() const override { return true; }
  bool lacks_nodes() const override { return lacks_nodes_; }

  EngineManners manners;
  bool others_are_gone = false;  ///< a unit that excludes a node finds no other node alive
  bool asks_for_more = true;     ///< fly() calls Meanwhile::more once, when no unit waits
  std::size_t rounds = 0;        ///< calls of fly()

 private:
  bool drawn(double probability) { return world_.draw.uniform() < probability; }
  std::size_t place(std::size_t count) {
    return std::min(static_cast<std::size_t>(world_.draw.uniform() * static_cast<double>(count)), count - 1);
  }
  std::size_t take(std::vector<std::size_t>& waiting) {
    const std::size_t at = place(waiting.size()), unit = waiting[at];
    waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(at));
    return unit;
  }
  void start(std::size_t unit, const std::set<std::string>& not_on) {
    std::vector<MadeUpNode*> free;
    for (MadeUpNode& node : nodes_) {
      if (!not_on.contains(node.name)) free.push_back(&node);
    }
    if (others_are_gone && !not_on.empty()) {
      lacks_nodes_ = true;
      return;
    }
    if (!free.empty()) workers_.push_back(std::make_unique<MadeUpWorker>(world_, *free[place(free.size())], unit));
  }

  MadeUpWorld& world_;
  std::vector<MadeUpNode>& nodes_;
  std::vector<std::unique_ptr<MadeUpWorker>> workers_;
  bool lacks_nodes_ = false;
};

}  // namespace skein::cli
