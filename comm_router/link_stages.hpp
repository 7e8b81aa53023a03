// Links that are not ideal: each message passes the permanent effects of a scenario, then the timed ones of a fault
// file. Time is simulated. Every random draw is keyed by (seed, effect, link, topic, the sender's sequence number), and
// the state of a burst by (seed, effect, link, step), so neither the order of arrival nor a restart of the router
// changes it. A restart loses the messages that wait in a queue. Not thread-safe; no bus.   Units: s, bytes.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "comm_router/link_gate.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario/scenario.hpp"

namespace skein::router {

class LinkStages final : public LinkModel {
 public:
  /// @param seed  of the run. Seed 0 draws like any other: loss that a scenario asks for occurs in nominal runs, too.
  LinkStages(const Scenario& scenario, const FaultPlan& faults, std::uint64_t seed);

  void begin_step(const Links& links) override { links_ = links; }
  LinkFate fate(std::uint64_t k, const RadioRoute& route, Node target, const SentMessage& message) override;
  void set_off(std::size_t fault, Tick tick) override;
  void set_by_hand(const std::vector<Fault>& faults) override;

 private:
  /// One effect on one directed link.
  struct Stage {
    LinkEffect effect;
    std::string name;                       ///< of effect and link, part of the key of every draw
    std::optional<std::size_t> fault = {};  ///< index in the plan; none: an effect of the scenario
    std::uint64_t first = 0, end = ~0;      ///< steps in which it acts: [first, end)
    double free_at_s = 0.0;                 ///< simulated time at which the queue is empty
    std::uint64_t burst_step = 0;           ///< the step to which `in_burst` belongs
    bool in_burst = false;
  };

  /// The effects of the stages that one message has passed so far.
  struct Passage {
    double delay_s = 0.0;
    bool twice = false;
    Payload payload;  ///< damaged copy; null: as it was sent
    LinkLoss loss = LinkLoss::none;
  };

  void add_effect(const LinkEffect& effect, const std::string& name, std::optional<std::size_t> fault = {});
  /// Sets the steps in which a stage acts, as far as they are known.
  void set_times(Stage& stage) const;
  void set_end(std::size_t fault);
  void pass(Stage& stage, std::uint64_t k, const RadioRoute& route, const SentMessage& message, Passage& passage);
  /// Queues a message for the link's bandwidth and adds its wait to `delay_s`. @returns false: the queue has no room.
  bool queue(Stage& stage, std::uint64_t k, double size_bytes, double& delay_s) const;
  bool in_burst(Stage& stage, std::uint64_t k) const;
  std::uint64_t step_of(Tick tick) const;
  bool is_cut(std::uint64_t k, Node from, Node to);

  const Scenario scenario_;
  FaultPlan faults_;
  const std::size_t planned_;  ///< number of faults without those by hand
  const std::uint64_t seed_;
  LinkMatrix<std::vector<Stage>> stages_;
  /// The data rate of each link on which a message has passed, if the conditions have path loss.
  std::map<std::pair<std::size_t, std::size_t>, Stage> radio_;
  Links links_;                  ///< of this step
  std::uint64_t cut_step_ = ~0;  ///< the step to which `cut_` belongs
  std::optional<LinkMatrix<std::uint8_t>> cut_;
};

}  // namespace skein::router
