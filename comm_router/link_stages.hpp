// Links that are not ideal: the standing effects of a scenario and the timed ones of a fault file, one after the
// other. Time is simulated. Every random draw is keyed by (seed, effect, link, topic, the sender's sequence number),
// and the state of a burst by (seed, effect, link, step): neither the order of arrival nor a restart of the router
// changes it. What a restart loses is what waits in a queue. Not thread-safe; no bus.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "comm_router/link_gate.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario.hpp"

namespace skein::router {

class LinkStages final : public LinkModel {
 public:
  /// @param seed  of the run; 0 draws too: who asks for loss gets loss.
  LinkStages(const Scenario& scenario, const FaultPlan& faults, std::uint64_t seed);

  void begin_step(const Links& links) override { links_ = links; }
  LinkFate fate(std::uint64_t k, const RadioRoute& route, Node target, const SentMessage& message) override;
  void set_off(std::size_t fault, Tick tick) override;
  void set_by_hand(const std::vector<Fault>& faults) override;

 private:
  /// One effect on one directed link.
  struct Stage {
    LinkEffect effect;
    std::string name;                       ///< of effect and link, part of every key
    std::optional<std::size_t> fault = {};  ///< of the plan; none: of the scenario
    std::uint64_t first = 0, end = ~0;      ///< steps in which it acts: [first, end)
    double free_at_s = 0.0;                 ///< when the last message in the queue will have left
    std::uint64_t burst_step = 0;           ///< the step to which `in_burst` belongs
    bool in_burst = false;
  };

  /// What happens to one message while it passes the stages.
  struct Passage {
    double delay_s = 0.0;
    bool twice = false;
    Payload payload;  ///< damaged; null: as it was sent
    LinkLoss loss = LinkLoss::none;
  };

  void add_effect(const LinkEffect& effect, const std::string& name, std::optional<std::size_t> fault = {});
  /// From when to when it acts, as far as that is known.
  void set_times(Stage& stage) const;
  void set_end(std::size_t fault);
  void pass(Stage& stage, std::uint64_t k, const RadioRoute& route, const SentMessage& message, Passage& passage);
  /// Queues for the bandwidth. @returns false when the message does not fit.
  bool queue(Stage& stage, std::uint64_t k, double size_bytes, double& delay_s) const;
  bool in_burst(Stage& stage, std::uint64_t k) const;
  std::uint64_t step_of(Tick tick) const;
  bool is_cut(std::uint64_t k, Node from, Node to);

  const Scenario scenario_;
  FaultPlan faults_;
  const std::size_t planned_;  ///< faults without those by hand
  const std::uint64_t seed_;
  LinkMatrix<std::vector<Stage>> stages_;
  LinkMatrix<Stage> radio_;      ///< the rate of each link, if the scenario's conditions have path loss
  Links links_;                  ///< of this step
  std::uint64_t cut_step_ = ~0;  ///< the step to which `cut_` belongs
  std::optional<LinkMatrix<std::uint8_t>> cut_;
};

}  // namespace skein::router
