#include "cli/sweep/engines.hpp"

#include <unistd.h>

#include <fstream>

#include "cli/study/side_by_side.hpp"
#include "cli/sweep/slurm.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/machine.hpp"
#include "host/preflight.hpp"
#include "host/threads.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// Each unit is a child process of this one.
class LocalEngine : public SweepEngine {
 public:
  LocalEngine(int jobs, const SweepFolder& folder, const Console& console)
      : jobs_(jobs), folder_(folder), console_(console) {}

  bool fly(const EngineWork& work, const Meanwhile& meanwhile) override {
    SideBySide side_by_side(static_cast<std::size_t>(jobs_), console_);
    return side_by_side.fly(
        {work.units.begin(), work.units.end()}, [&](std::size_t unit) { return start(unit); },
        [&](std::size_t, const ExitStatus&) { meanwhile.tell(); });
  }
  std::vector<EngineJob> jobs() override { return {}; }
  bool has_other_nodes() const override { return false; }

 private:
  ProgramSpec start(std::size_t unit) const {
    return {"",
            {"/bin/sh", fly_script(folder_), std::to_string(unit)},
            environment_with({}),
            folder_.dir() / "log" / "local.log",
            true};
  }

  const int jobs_;
  const SweepFolder& folder_;
  const Console console_;
};

/// GNU parallel distributes the units, on this machine or over ssh.
class ParallelEngine : public SweepEngine {
 public:
  ParallelEngine(std::vector<std::string> logins, std::optional<int> jobs, const SweepFolder& folder,
                 const Console& console)
      : logins_(std::move(logins)), jobs_(jobs), folder_(folder), console_(console) {
    if (!is_installed("parallel")) {
      throw InputError("--executor parallel: there is no GNU parallel; on Debian, apt-get install parallel");
    }
  }

  bool fly(const EngineWork& work, const Meanwhile& meanwhile) override {
    const fs::path list = folder_.dir() / "lists" / "parallel";
    std::string lines;
    for (const std::size_t unit : work.units) lines += std::to_string(unit) + "\n";
    write_file_atomically(list, lines);
    SideBySide side_by_side(1, console_);
    return side_by_side.fly(
        {0}, [&](std::size_t) { return program(list); }, [&](std::size_t, const ExitStatus&) { meanwhile.tell(); });
  }
  std::vector<EngineJob> jobs() override { return {}; }
  bool has_other_nodes() const override { return !logins_.empty(); }

 private:
  ProgramSpec program(const fs::path& list) const {
    // --termseq: after SIGTERM, a unit has 5 s to finish its current step.
    std::vector<std::string> argv = {"/usr/bin/env"};
    // SideBySide sets this variable to the threads of a single flight; parallel's slots must not inherit it.
    if (::getenv(kThreadsVariable) == nullptr) argv.insert(argv.end(), {"-u", kThreadsVariable});
    argv.insert(argv.end(), {"parallel", "--plain", "--termseq", "TERM,5000,KILL,25"});
    if (jobs_) argv.insert(argv.end(), {"--jobs", std::to_string(*jobs_)});
    for (const std::string& login : logins_) argv.insert(argv.end(), {"--sshlogin", login});
    // A unit that fails is tried on another host.
    if (!logins_.empty()) argv.insert(argv.end(), {"--ssh", "ssh -o BatchMode=yes", "--retries", "3"});
    argv.insert(argv.end(), {"--arg-file", list, "/bin/sh " + shell_word(fly_script(folder_)) + " {}"});
    ProgramSpec spec{"", std::move(argv), environment_with({}), folder_.dir() / "log" / "parallel.log", true};
    spec.minded = true;
    return spec;
  }

  const std::vector<std::string> logins_;
  const std::optional<int> jobs_;
  const SweepFolder& folder_;
  const Console console_;
};

}  // namespace

bool is_installed(const std::string& program) {
  const char* path = ::getenv("PATH");
  for (const std::string& folder : split(path == nullptr ? "" : path, ':')) {
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

fs::path fly_script(const SweepFolder& folder) { return folder.dir() / "fly"; }

fs::path launcher_file() {
  const char* chosen = ::getenv("SKEIN_LAUNCHER");
  return chosen != nullptr && *chosen != '\0' ? fs::path(chosen) : fs::absolute(program_dir() / "skein");
}

void write_fly_script(const SweepFolder& folder, const fs::path& study, const fs::path& working_folder,
                      const std::optional<int>& jobs) {
  std::string script =
      "#!/bin/sh\n# Flies unit $1 of the sweep in this folder; any node may, and as often as it likes.\n";
  script += "cd " + shell_word(working_folder) + " || exit 3\n";
  for (const std::string& entry : environment_with({})) {
    const std::size_t equals = entry.find('=');
    // The launcher of a pack sets its variables itself on each node.
    if (!entry.starts_with("SKEIN_") || (::getenv("SKEIN_LAUNCHER") != nullptr && !entry.starts_with("SKEIN_AGENT")))
      continue;
    script += "export " + entry.substr(0, equals) + "=" + shell_word(entry.substr(equals + 1)) + "\n";
  }
  // Other units fly on the same node. Slurm tells how many cores belong to this unit; other engines divide the cores by
  // the number of slots, which is that of the cores unless --jobs says otherwise.
  const std::string slots = jobs ? std::to_string(*jobs) : "$(nproc)";
  script += "threads=${SLURM_CPUS_ON_NODE:-$(($(nproc) / " + slots + "))}\n";
  script += "[ \"$threads\" -ge 1 ] || threads=1\n";
  script += std::string("export ") + kThreadsVariable + "=\"${" + kThreadsVariable + ":-$threads}\"\n";
  script += "log=" + shell_word(folder.dir() / "log") + "/$(printf %06d \"$1\").log\n";
  script += "exec " + shell_word(launcher_file()) + " --unit " + shell_word(study) + " \"$1\" >>\"$log\" 2>&1\n";
  write_file_atomically(fly_script(folder), script);
}

std::unique_ptr<SweepEngine> make_engine(const SweepOptions& options, std::optional<int> jobs,
                                         const SweepFolder& folder, const Console& console) {
  if (options.executor == "slurm") return make_slurm_engine(options, jobs, folder, console);
  if (options.executor == "parallel") {
    return std::make_unique<ParallelEngine>(options.logins, jobs, folder, console);
  }
  return std::make_unique<LocalEngine>(jobs.value_or(usable_cores()), folder, console);
}

}  // namespace skein::cli
