#include "sim_server/fault_node.hpp"

#include <spdlog/spdlog.h>

#include <variant>

#include "bus/lockstep/names.hpp"
#include "process/files/atomic_file.hpp"
#include "results/run_folder.hpp"

namespace skein::sim {

using What = status::Order::What;

FaultNode::FaultNode(const Scenario& scenario, Simulation& simulation, bus::LockstepServer& server, StatusPipe& status,
                     const recording::ReplayOptions& replay, const std::filesystem::path& folder)
    : simulation_(simulation),
      server_(server),
      status_(status),
      replay_(replay),
      folder_(folder),
      period_(scenario.exchange_ticks()),
      planned_(simulation.faults().faults.size()),
      world_(simulation),
      signals_(scenario, world_),
      timeline_(simulation.faults()),
      processes_(simulation.faults()),
      hand_(scenario, simulation.faults()) {}

std::vector<std::string> FaultNode::begin_step() {
  std::vector<std::string> lines = timeline_.enter_step(simulation_.step(), simulation_.tick());
  for (const std::string& line : lines) spdlog::info("{}", line);
  return lines;
}

std::vector<FaultNode::Change> FaultNode::changes() const {
  std::vector<Change> changes;
  for (const auto& [index, begins] : timeline_.changes()) {
    const Fault& fault = simulation_.faults().faults[index];
    const bool by_hand = is_by_hand(index);
    const std::uint64_t number = by_hand ? hand_.all()[index - planned_].number : index;
    changes.push_back({{number, by_hand, fault_kind(fault), fault_target(fault)}, begins});
  }
  return changes;
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

// The launcher starts or resumes the program: a killed or stopped program receives no messages of the server.
void FaultNode::let_back_victims() {
  const Tick next_tick = simulation_.tick() + period_;
  for (const auto& [member, killed, kind] : processes_.take_ending(next_tick)) {
    if (server_.let_back(member)) tell_order(member, killed ? What::start : What::resume, next_tick);
  }
}

std::string FaultNode::obey(const view::FaultOrder& order) {
  const Tick next_tick = simulation_.tick() + period_;
  if (order.begins) {
    const Fault fault{.at_s = seconds(next_tick), .until_s = {}, .action = *order.begins};
    const bool of_process = std::holds_alternative<Kill>(fault.action) || std::holds_alternative<Pause>(fault.action);
    if (of_process && !server_.is_member(fault_target(fault)))
      return fault_target(fault) + " takes no part in the run now";
  }
  if (std::string reason = hand_.obey(order, next_tick); !reason.empty()) return reason;
  std::vector<Fault> faults;
  for (const HandFault& one : hand_.all()) faults.push_back(one.fault);
  simulation_.set_faults_by_hand(faults);
  const std::string trouble = write_if_possible(folder_ / run_folder::kByHand, hand_.file_text());
  if (!trouble.empty()) warnings_.push_back(trouble);
  return {};
}

std::vector<FaultReport> FaultNode::report() const {
  std::vector<FaultReport> report = timeline_.report();
  for (std::size_t i = planned_; i < report.size(); ++i) report[i].by_hand = true;
  return report;
}

void FaultNode::tell_order(const std::string& member, What order, Tick tick) {
  status_.send_surely(status::line_json(status::Order{member, order, seconds(tick)}));
}

}  // namespace skein::sim
