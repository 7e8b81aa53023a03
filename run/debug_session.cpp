#include "run/debug_session.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "results/run_folder.hpp"
#include "run/fleet_programs.hpp"

namespace skein::cli {
namespace {

using How = Debuggee::How;

}  // namespace

DebugSession::DebugSession(const FleetPlan& plan, const std::vector<Debuggee>& debuggees, int base_domain,
                           const std::filesystem::path& out, const SecureFolders& secure, ProgressView& view,
                           std::ostream& console, bool terminal)
    : plan_(plan), view_(view), console_(console), terminal_(terminal), log_file_(out / run_folder::kFleetLog) {
  bool here = false;
  for (const Debuggee& debuggee : debuggees) {
    watches_.push_back(std::make_unique<DebugWatch>(debuggee, out, program_file(plan, debuggee.program)));
    const std::string text = introduction(plan, debuggee, base_domain, out, secure);
    if (!text.empty()) view_.message(text);
    here = here || debuggee.here;
  }
  if (!here) return;
  log_.open(log_file_);
  view_.write_to(log_, false);
}

DebugSession::~DebugSession() {
  if (log_.is_open()) view_.write_to(console_, terminal_);
}

std::string DebugSession::introduction(const FleetPlan& plan, const Debuggee& debuggee, int base_domain,
                                       const std::filesystem::path& out, const SecureFolders& secure) const {
  const std::string& member = debuggee.member;
  switch (debuggee.how) {
    case How::by_hand:
      return "Start the agent of " + member + " yourself; the fleet waits for it:\n\n  " +
             debug_command(plan, debuggee.program, base_domain, out, secure) + "\n";
    case How::gdbserver:
      return member + " waits in gdbserver; the fleet waits for it:\n\n  " +
             connect_command(debuggee, program_file(plan, debuggee.program)) + "\n";
    case How::gdb:
    case How::command:
      if (!debuggee.here) return {};
      return member + " is in " + std::filesystem::path(debuggee.tool[0]).filename().string() + " here" +
             (debuggee.how == How::gdb ? "; `run` starts it, and the fleet waits for it" : "") +
             "; the fleet's progress goes to " + log_file_.string();
    case How::pdb:
      return member + " is in pdb here: it stops in plan(), and `continue` goes on; the fleet waits for it, and its " +
             "progress goes to " + log_file_.string();
    case How::inside:
      return member +
             " is in gdb here, in its container; `continue` starts it, and the fleet waits for it; the fleet's " +
             "progress goes to " + log_file_.string();
    case How::wait:
      break;  // its process id is not known yet: take_ended() prints the message
  }
  return {};
}

std::vector<const DebugWatch*> DebugSession::take_ended() {
  std::vector<const DebugWatch*> ended;
  for (const auto& watch : watches_) {
    if (watch->appeared() && watch->debuggee().how == How::wait) {
      view_.message(fmt::format("{0} waits before its first step until you attach (or: kill -CONT {1}):\n\n  {2}\n",
                                watch->debuggee().member, watch->pid(), attach_command(watch->pid())));
    }
    if (watch->ended() && watch->debuggee().how != How::wait) ended.push_back(watch.get());
  }
  return ended;
}

void DebugSession::await_reports(std::chrono::milliseconds timeout) const {
  for (const auto& watch : watches_) {
    if (!is_exec(plan_, watch->debuggee().program)) watch->await_end(timeout);  // a user's command writes no report
  }
}

const DebugWatch* DebugSession::find(const std::string& program) const {
  const auto found = std::ranges::find_if(watches_, [&](const auto& w) { return w->debuggee().program == program; });
  return found == watches_.end() ? nullptr : found->get();
}

void DebugSession::on_restart(const std::string& program) {
  take_back(program);
  const DebugWatch* watch = find(program);
  if (watch != nullptr && watch->debuggee().here) view_.write_to(log_, false);
}

void DebugSession::on_exit(const std::string& program) {
  const DebugWatch* watch = find(program);
  if (watch != nullptr && watch->debuggee().here) view_.write_to(console_, terminal_);
}

}  // namespace skein::cli
