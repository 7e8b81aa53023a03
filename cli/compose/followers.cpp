#include "cli/compose/followers.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "core/text/text.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_run.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// Script that starts gdb in a container once the log says that the program waits for a debugger; does nothing if the
/// container has ended.
std::string gdb_inside(const std::string& container, const fs::path& log) {
  return fmt::format(R"sh(while [ "$(docker inspect --format '{{{{.State.Running}}}}' {0} 2>&1)" = true ]; do
  process=$(sed -n 's/.*process \([0-9]*\) waits for a debugger.*/\1/p' {1} 2>/dev/null | tail -n 1)
  [ -z "$process" ] || break
  sleep 0.1
done
[ ! -t 0 ] || terminal=--tty
[ -z "$process" ] || docker exec --interactive $terminal {0} gdb -q -p "$process"
)sh",
                     container, shell_word(log));
}

/// Script of a follower: passes SIGTERM on to the container, and ends with its exit code, or by kEngineLost. SIGTERM
/// goes to the whole process group, so `docker logs` runs in another one (setsid).
/// @param streams  redirection of the container's output. @param meanwhile  commands to run while the container does
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
    if (program.here) {  // the follower's stderr is the terminal, which gdb uses
      streams.insert(0, " 2>" + shell_word(program.log));
      meanwhile = gdb_inside(id, program.log);
    }
    program.argv = {"/bin/sh", "-c", follower(id, streams, meanwhile)};
    programs.push_back(std::move(program));
  }
  // In the order of the launcher: the servers come first.
  const auto rank = [](const ProgramSpec& program) { return std::ranges::find(programs::kServers, program.name); };
  std::ranges::stable_sort(programs, {}, rank);
  return programs;
}

}  // namespace skein::cli
