#include "comm_router/link_stages.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/math/random_stream.hpp"

namespace skein::router {
namespace {

/// Length of the encapsulation header, which precedes the content of a serialised message.
constexpr std::size_t kEncapsulationBytes = 4;

/// A copy in which one or three random bits are flipped. With an odd number of flips, the copy always differs from the
/// original, even if two of them hit the same bit. nullptr if the message has no content.
Payload with_flipped_bits(const std::vector<std::uint8_t>& bytes, RandomStream& random) {
  if (bytes.size() <= kEncapsulationBytes) return nullptr;
  auto damaged = std::make_shared<std::vector<std::uint8_t>>(bytes);
  const std::uint64_t bits = 8 * (bytes.size() - kEncapsulationBytes);
  for (std::uint64_t flips = random.bits() % 2 == 0 ? 1 : 3; flips > 0; --flips) {
    const std::uint64_t bit = random.bits() % bits;
    (*damaged)[kEncapsulationBytes + bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
  }
  return damaged;
}

}  // namespace

LinkStages::LinkStages(const Scenario& scenario, const FaultPlan& faults, std::uint64_t seed)
    : scenario_(scenario),
      faults_(faults),
      planned_(faults.faults.size()),
      seed_(seed),
      stages_(scenario.fleet.size() + 1),
      links_(scenario.fleet.size() + 1) {
  for (std::size_t i = 0; i < scenario.links.size(); ++i) {
    add_effect(scenario.links[i], "radio.links[" + std::to_string(i) + "]");
  }
  for (std::size_t i = 0; i < faults.faults.size(); ++i) {
    const auto* effect = std::get_if<LinkEffect>(&faults.faults[i].action);
    if (effect) add_effect(*effect, fault_path(i), i);
  }
}

void LinkStages::add_effect(const LinkEffect& effect, const std::string& name, std::optional<std::size_t> fault) {
  if (!effect.acts_on_messages()) return;  // only a `range_m`, which the server applies: it closes links beyond it
  for (const Node from : scenario_.nodes()) {
    for (const Node to : scenario_.nodes()) {
      const std::string &source = scenario_.node_name(from), &target = scenario_.node_name(to);
      if (from == to || !names_node(effect.from, source) || !names_node(effect.to, target)) continue;
      Stage stage{.effect = effect, .name = name + " " + source + " " + target, .fault = fault};
      set_times(stage);
      stages_.at(from, to).push_back(std::move(stage));
    }
  }
}

void LinkStages::set_times(Stage& stage) const {
  if (!stage.fault) return;
  const Fault& fault = faults_.faults[*stage.fault];
  stage.first = fault.waits ? ~std::uint64_t{0} : step_of(fault.begin());
  stage.end = fault.end() ? step_of(*fault.end()) : ~std::uint64_t{0};
  stage.burst_step = stage.first;
}

void LinkStages::set_off(std::size_t fault, Tick tick) {
  if (!faults_.faults.at(fault).waits) return;
  faults_.faults[fault].set_off(tick);
  for (const Node from : scenario_.nodes()) {
    for (const Node to : scenario_.nodes()) {
      for (Stage& stage : stages_.at(from, to)) {
        if (stage.fault == fault) set_times(stage);
      }
    }
  }
}

void LinkStages::set_by_hand(const std::vector<Fault>& faults) {
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const std::size_t index = planned_ + i;
    const auto* effect = std::get_if<LinkEffect>(&faults[i].action);
    if (index == faults_.faults.size()) {
      faults_.faults.push_back(faults[i]);
      if (effect != nullptr) add_effect(*effect, fault_path(index), index);
    } else {
      faults_.faults[index] = faults[i];
      set_end(index);
    }
  }
  cut_step_ = ~std::uint64_t{0};
}

/// Sets the end of a fault's stages once it is known; their state is kept.
void LinkStages::set_end(std::size_t fault) {
  const auto end = faults_.faults[fault].end();
  for (const Node from : scenario_.nodes()) {
    for (const Node to : scenario_.nodes()) {
      for (Stage& stage : stages_.at(from, to)) {
        if (stage.fault == fault) stage.end = end ? step_of(*end) : ~std::uint64_t{0};
      }
    }
  }
}

LinkFate LinkStages::fate(std::uint64_t k, const RadioRoute& route, Node target, const SentMessage& message) {
  if (is_cut(k, route.source, target)) return {.loss = LinkLoss::fault};
  Passage passage;
  if (const std::uint8_t level = links_.at(route.source, target); level > 0 && scenario_.conditions.radio.on()) {
    Stage& radio = radio_[{route.source, target}];
    const double rate_bit_s = kRadioRates.at(level - 1U).rate_bit_s;
    radio.effect.bandwidth_bit_s = scenario_.conditions.radio.rate_share * rate_bit_s;
    const auto size_bytes = static_cast<double>(message.payload->size());
    if (!queue(radio, k, size_bytes, passage.delay_s)) return {.loss = LinkLoss::overflow};
  }
  for (Stage& stage : stages_.at(route.source, target)) {
    if (k < stage.first || k >= stage.end || !names_topic(stage.effect.topics, route.ros_topic)) continue;
    pass(stage, k, route, message, passage);
    if (passage.loss != LinkLoss::none) return {.loss = passage.loss};
  }
  const auto delay = static_cast<std::uint64_t>(std::ceil(passage.delay_s / scenario_.exchange_period_s - 1e-9));
  return {.delay_steps = delay, .copies = passage.twice ? 2 : 1, .payload = std::move(passage.payload)};
}

// Draws all random numbers for every message, whether they are needed or not, so that the numbers of one effect do not
// depend on the settings of the others.
void LinkStages::pass(Stage& stage, std::uint64_t k, const RadioRoute& route, const SentMessage& message,
                      Passage& passage) {
  const LinkEffect& effect = stage.effect;
  RandomStream random(seed_, "link", stage.name + " " + route.ros_topic, message.sequence);
  const double loss = random.uniform(), burst_loss = random.uniform(), jitter = random.uniform();
  const double duplication = random.uniform(), reordering = random.uniform();
  const bool lost_in_burst = effect.burst_loss && in_burst(stage, k) && burst_loss < effect.burst_loss->loss;
  if (loss < effect.loss || lost_in_burst) {
    passage.loss = LinkLoss::fault;
    return;
  }
  if (effect.bandwidth_bit_s && !queue(stage, k, static_cast<double>(message.payload->size()), passage.delay_s)) {
    passage.loss = LinkLoss::overflow;
    return;
  }
  passage.delay_s += effect.latency_s + jitter * effect.jitter_s;
  if (effect.reordering && reordering < effect.reordering->probability) passage.delay_s += effect.reordering->delay_s;
  passage.twice = passage.twice || duplication < effect.duplication;
  if (random.uniform() < effect.corruption) {
    passage.payload = with_flipped_bits(passage.payload ? *passage.payload : *message.payload, random);
  }
}

bool LinkStages::queue(Stage& stage, std::uint64_t k, double size_bytes, double& delay_s) const {
  const double bytes_per_s = *stage.effect.bandwidth_bit_s / 8.0;
  const double now_s = seconds(static_cast<Tick>(k) * scenario_.exchange_ticks()) + delay_s;
  const double waiting_bytes = std::max(0.0, stage.free_at_s - now_s) * bytes_per_s;
  if (waiting_bytes > 0.0 && waiting_bytes + size_bytes > static_cast<double>(stage.effect.queue_bytes)) return false;
  stage.free_at_s = std::max(stage.free_at_s, now_s) + size_bytes / bytes_per_s;
  delay_s += stage.free_at_s - now_s;
  return true;
}

// Advances the two-state Markov chain of the bursts to step k. It begins in the good state in the effect's first step,
// and a restarted router recomputes it from there.
bool LinkStages::in_burst(Stage& stage, std::uint64_t k) const {
  const BurstLoss& burst = *stage.effect.burst_loss;
  while (stage.burst_step < k) {
    ++stage.burst_step;
    const double mean_s = stage.in_burst ? burst.mean_burst_s : burst.mean_good_s;
    const double change = RandomStream(seed_, "link_burst", stage.name, stage.burst_step).uniform();
    if (change < scenario_.exchange_period_s / mean_s) stage.in_burst = !stage.in_burst;
  }
  return stage.in_burst;
}

std::uint64_t LinkStages::step_of(Tick tick) const {
  const Tick period = scenario_.exchange_ticks();
  return static_cast<std::uint64_t>((tick + period - 1) / period);
}

bool LinkStages::is_cut(std::uint64_t k, Node from, Node to) {
  if (cut_step_ != k) {
    cut_ = cut_links(faults_, scenario_, static_cast<Tick>(k) * scenario_.exchange_ticks());
    cut_step_ = k;
  }
  return cut_ && cut_->at(from, to) != 0;
}

}  // namespace skein::router
