#include "cli/compose/followers.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "cli/run/fleet_run.hpp"
#include "core/text/text.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// gdb in a container, once its program has written to its log that it stands; none for one that has ended.
std::string gdb_inside(const std::string& container, const fs::path& log) {
  return fmt::format(R"sh(while [ "$(docker inspect --format '{{{{.State.Running}}}}' {0} 2>&1)" = true ]; do
  process=$(sed -n 's/.*process \([0-9]*\) stands until a debugger.*/\1/p' {1} 2>/dev/null | tail -n 1)
  [ -z "$process" ] || break
  sleep 0.1
done
[ ! -t 0 ] || terminal=--tty
[ -z "$process" ] || docker exec --interactive $terminal {0} gdb -q -p "$process"
)sh",
                     container, shell_word(log));
}

/// Passes a SIGTERM on and ends as the container does, or by kEngineLost. The signal is for the whole group, so what
/// listens is in another one. @param streams  where the container's go. @param meanwhile  what is done while it runs
std::string follower(const std::string& container, const std::string& streams, const std::string& meanwhile) {
  return "trap 'docker kill --signal=TERM " + container + " >/dev/null 2>&1' TERM\n" + "setsid docker logs --follow " +
         container + streams + " &\n" + meanwhile + "wait $!\nwait\ncode=$(docker wait " + container +
         ")\n[ -n \"$code\" ] || kill -" + std::to_string(kEngineLost) + " $$\nexit \"$code\"";
}

}  // namespace

std::vector<ProgramSpec> followers(const std::map<std::string, std::string>& containers, const FleetPlan& plan,
                                   const ComposeLayout& layout, const fs::path& out) {
  std::vector<ProgramSpec> programs;
  for (const auto& [name, id] : containers) {
    const bool ours = !layout.images.contains(programs::member_name(name));
    ProgramSpec program{name, {}, environment_with({}), out / run_folder::log_file(name)};
    if (ours) program.most_status_bytes = std::numeric_limits<std::uint64_t>::max();
    const auto debuggee = std::ranges::find(plan.debug, name, &Debuggee::program);
    program.here = debuggee != plan.debug.end() && debuggee->here;
    std::string streams = ours ? " >&3" : " >&2", meanwhile;
    if (program.here) {  // its own standard error is the terminal, and gdb's
      streams.insert(0, " 2>" + shell_word(program.log));
      meanwhile = gdb_inside(id, program.log);
    }
    program.argv = {"/bin/sh", "-c", follower(id, streams, meanwhile)};
    programs.push_back(std::move(program));
  }
  // As under the launcher: those that every fleet has one of come first.
  const auto rank = [](const ProgramSpec& program) { return std::ranges::find(programs::kServers, program.name); };
  std::ranges::stable_sort(programs, {}, rank);
  return programs;
}

}  // namespace skein::cli
