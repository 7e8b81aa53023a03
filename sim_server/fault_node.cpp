#include "sim_server/fault_node.hpp"

#include "bus/lockstep/names.hpp"

namespace skein::sim {

using What = status::Order::What;

FaultNode::FaultNode(const Scenario& scenario, Simulation& simulation, bus::LockstepServer& server, StatusPipe& status,
                     const recording::ReplayOptions& replay)
    : simulation_(simulation),
      server_(server),
      status_(status),
      replay_(replay),
      period_(scenario.exchange_ticks()),
      signals_(scenario, simulation),
      timeline_(simulation.faults()),
      processes_(simulation.faults()) {}

std::vector<std::string> FaultNode::begin_step() {
  return timeline_.enter_step(simulation_.step(), simulation_.tick());
}

void FaultNode::take_out_victims() {
  const Tick tick = simulation_.tick();
  for (const auto& [member, killed, kind] : processes_.take_beginning(tick)) {
    if (server_.take_out(member, killed ? bus::kOrderKill : bus::kOrderStop)) {
      tell_order(member, killed ? What::kill : What::stop, tick);
    } else if (replay_.takes_part(member)) {
      warnings_.push_back(kind + " " + member + ": it took no part in the run then");
    }
  }
}

void FaultNode::end_step() {
  signals_.end_step([this](const std::string& member) { return server_.is_member(member); });
  const Tick next_tick = simulation_.tick() + period_;
  const std::vector<Fault>& faults = simulation_.faults().faults;
  for (std::size_t i = 0; i < faults.size(); ++i) {
    if (!faults[i].may_begin(next_tick) || !holds(*faults[i].when)) continue;
    simulation_.set_off(i, next_tick);
    msg::FaultBegin begin;
    begin.fault(static_cast<std::uint32_t>(i));
    begin.tick(next_tick);
    begun_.push_back(begin);
  }
}

bool FaultNode::holds(const FaultCondition& when) const {
  std::vector<double> values;
  for (const SignalUse& signal : when.signals) values.push_back(signals_.value(signal));
  return margin_at(when.condition, {values, values, values}).holds;
}

// The order to carry on comes from the launcher: the program cannot hear us.
void FaultNode::let_back_victims() {
  const Tick next_tick = simulation_.tick() + period_;
  for (const auto& [member, killed, kind] : processes_.take_ending(next_tick)) {
    if (server_.let_back(member)) tell_order(member, killed ? What::start : What::resume, next_tick);
  }
}

void FaultNode::tell_order(const std::string& member, What order, Tick tick) {
  status_.send_surely(status::line_json(status::Order{member, order, seconds(tick)}));
}

}  // namespace skein::sim
