#include "sim_server/hand_faults.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "core/faults/fault_check.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/text/text.hpp"
#include "results/run_folder.hpp"

namespace skein::sim {
namespace {

/// Maximum number of faults by hand, because each step has to tell the router all of them.
constexpr std::size_t kMost = 200;

bool overlap(const Fault& a, const Fault& b) {
  constexpr Tick kNever = std::numeric_limits<Tick>::max();
  return a.begin() < b.end().value_or(kNever) && b.begin() < a.end().value_or(kNever);
}

/// The thing that a fault acts on and on which only one fault may act at a time. In a fault file several effects may
/// act on a link; by hand only one.
std::optional<std::string> held(const Fault& fault) {
  if (std::holds_alternative<LinkEffect>(fault.action)) return "the link " + fault_target(fault);
  return held_by(fault.action);
}

bool is_of_process(const Fault& fault) {
  return std::holds_alternative<Kill>(fault.action) || std::holds_alternative<Pause>(fault.action);
}

/// Time as a fault file has it: rounded to 0.1 ms, without the rounding errors of a product. A tick is 2.5 ms.
double file_time_s(Tick tick) { return std::round(seconds(tick) * 1e4) / 1e4; }

/// The reason in an InputError, without the name of the file and the key, which the viewer does not know.
std::string reason_of(const InputError& error) {
  const std::string text = error.what();
  const std::string line = text.substr(0, text.find('\n'));
  const std::size_t key = line.find("faults["), behind = key == std::string::npos ? key : line.find(": ", key);
  return behind == std::string::npos ? line : line.substr(behind + 2);
}

}  // namespace

HandFaults::HandFaults(const Scenario& scenario, const FaultPlan& own) : scenario_(scenario), own_(own.faults) {}

std::string HandFaults::obey(const view::FaultOrder& order, Tick next) {
  return order.begins ? begin(order, next) : end(order.ended, next);
}

std::string HandFaults::begin(const view::FaultOrder& order, Tick next) {
  if (faults_.size() >= kMost) return fmt::format("a run can have at most {} faults by hand", kMost);
  Fault fault{.at_s = file_time_s(next), .until_s = {}, .action = *order.begins};
  if (order.for_s) {
    const Tick period = scenario_.exchange_ticks();
    fault.until_s = file_time_s(next + std::max(period, (ticks(*order.for_s) + period - 1) / period * period));
  }
  if (is_of_process(fault) && fault_target(fault) == programs::kStation && !fault.until_s) {
    return "the station serves this page, and no viewer could bring it back: say for how long (for_s)";
  }
  if (const auto* link = std::get_if<LinkEffect>(&fault.action); link != nullptr && link->from == link->to) {
    return "a link is between two nodes";
  }
  if (std::string reason = contradiction(fault); !reason.empty()) return reason;
  faults_.push_back({next_number_, std::move(fault)});
  std::string reason = unreadable();
  if (reason.empty()) {
    ++next_number_;
  } else {
    faults_.pop_back();
  }
  return reason;
}

std::string HandFaults::end(std::uint64_t number, Tick next) {
  const auto found = std::ranges::find(faults_, number, &HandFault::number);
  if (found == faults_.end()) return "there is no such fault, or it is over";
  Fault& fault = found->fault;
  if (fault.end() && *fault.end() <= next) return "this fault is over";
  if (fault.begin() < next) {
    fault.until_s = file_time_s(next);
  } else {
    faults_.erase(found);  // the exchange with which it would begin has not come
  }
  return {};
}

std::string HandFaults::contradiction(const Fault& fault) const {
  const auto what = held(fault);
  const auto told = [&](const Fault& other) {
    return fmt::format("{} has a fault {} already ({} of {})", *what,
                       other.begin() <= fault.begin() ? "now" : fmt::format("from {} s on", shortest(other.at_s)),
                       fault_kind(other), fault_target(other));
  };
  for (const Fault& other : own_) {
    const bool same = what && !std::holds_alternative<LinkEffect>(other.action) && held(other) == what;
    if (same && overlap(fault, other)) return told(other);
  }
  for (const HandFault& other : faults_) {
    if (what && held(other.fault) == what && overlap(fault, other.fault)) return told(other.fault);
  }
  return {};
}

/// The error message of the reader of fault files for all faults by hand; empty: none.
std::string HandFaults::unreadable() const try {
  read_faults_by_hand(file_text(), "by hand", scenario_);
  return {};
} catch (const InputError& error) {
  return reason_of(error);
}

std::vector<HandFault> HandFaults::open(Tick tick) const {
  std::vector<HandFault> open;
  for (const HandFault& one : faults_) {
    if (!one.fault.end() || *one.fault.end() > tick) open.push_back(one);
  }
  return open;
}

std::vector<std::string> HandFaults::lines() const {
  std::vector<std::string> lines;
  for (const HandFault& one : faults_) lines.push_back(fault_line(one.fault));
  return lines;
}

std::string HandFaults::file_text() const {
  std::vector<std::string> all;
  for (const Fault& fault : own_) all.push_back(fault_line(fault));
  for (std::string& line : lines()) all.push_back(std::move(line));
  return by_hand_text("what failed in a flight of " + scenario_.name + ", by its fault file and by hand", all);
}

}  // namespace skein::sim
