#include "cli/compose/engine.hpp"

#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/environment.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLastLines = 5;

/// Runs a shell command. @param log  receives its output; empty: that is discarded. @returns its exit code; 128 + N if
/// signal N ended it.
int shell(const std::string& command, const fs::path& log = {}) {
  const ExitStatus exit = run_to_end(
      {"docker", {"/bin/sh", "-c", log.empty() ? command + " >/dev/null 2>&1" : command}, environment_with({}), log});
  return exit.signal != 0 ? 128 + exit.signal : exit.code;
}

/// The command of docker-compose: version 2 is part of Docker's client, version 1 a program of its own.
std::string compose_program() {
  if (shell("docker compose version") == 0) return "docker compose";
  if (shell("docker-compose version") == 0) return "docker-compose";
  throw InputError("there is no docker-compose: on Debian, apt-get install docker-compose");
}

}  // namespace

void check_engine(const std::vector<std::string>& images) {
  const ScratchDir scratch;
  const fs::path log = scratch.path() / "docker.log";
  if (shell("docker version --format '{{.Server.Version}}'", log) != 0) {
    throw InputError("no Docker engine answers (`skein doctor` looks closer):" + last_lines_below(log, kLastLines));
  }
  compose_program();
  for (const std::string& image : images) {
    if (shell("docker image inspect " + shell_word(image)) == 0) continue;
    throw InputError("the engine has no image '" + image + "'; docs/how-to-containers.md tells how Skein's are built");
  }
}

void check_gdb(const std::string& image, const std::string& member) {
  if (shell("docker run --rm --network none --entrypoint gdb " + shell_word(image) + " --version") == 0) return;
  throw InputError("--debug " + member + ": the image '" + image +
                   "' has no gdb; skein-agent-debug of docker/Dockerfile has it (SKEIN_AGENT_IMAGE names it), or say " +
                   member + "=wait");
}

ComposeProject::ComposeProject(fs::path file, std::string name, fs::path log, std::ostream& err)
    : program_(compose_program()), file_(std::move(file)), name_(std::move(name)), log_(std::move(log)), err_(err) {}

ComposeProject::~ComposeProject() {
  constexpr int kAttempts = 3;  // continues even if the user presses Ctrl-C meanwhile
  const std::string down = command("down --volumes --remove-orphans --timeout 2");
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      if (shell(down, log_) == 0) return;
      break;
    } catch (const Interrupted&) {
    } catch (const std::exception&) {  // the shell cannot be started
      break;
    }
  }
  err_ << "the containers and networks of this run could not be removed (" << log_.string()
       << " has the reason) and may still be there; once the engine answers, remove them with\n  " << down << std::endl;
}

std::string ComposeProject::command(const std::string& what) const {
  return program_ + " --project-name " + shell_word(name_) + " --file " + shell_word(file_) + " " + what;
}

void ComposeProject::up() {
  if (shell(command("up --detach"), log_) == 0) return;
  std::ifstream in(log_);
  const std::string said{std::istreambuf_iterator<char>(in), {}};
  const bool no_room = said.find("address pool") != std::string::npos;
  throw std::runtime_error(std::string("docker-compose cannot make the containers") +
                           (no_room ? " (the engine has no address ranges left for this many networks: give it more by "
                                      "\"default-address-pools\" in its daemon.json, or name one with --subnet)"
                                    : "") +
                           "; the end of " + log_.string() + ":" + last_lines_below(log_, kLastLines));
}

std::map<std::string, std::string> ComposeProject::starts(const std::map<std::string, std::string>& containers) {
  const ScratchDir scratch;
  const fs::path said = scratch.path() / "started";
  std::map<std::string, std::string> starts;
  for (const auto& [service, id] : containers) {
    const int code = shell("docker inspect --format '{{.State.StartedAt}}' " + id, said);
    std::ifstream in(said);
    std::string started;
    if (code == 0 && in >> started) starts[id] = started;
  }
  return starts;
}

void ComposeProject::add_later_logs(const std::map<std::string, std::string>& containers,
                                    const std::map<std::string, std::string>& starts, const fs::path& folder,
                                    const std::set<std::string>& foreign) {
  const std::map<std::string, std::string> last = ComposeProject::starts(containers);
  for (const auto& [service, id] : containers) {
    const auto before = starts.find(id), now = last.find(id);
    if (before == starts.end() || now == last.end() || before->second == now->second) continue;
    const fs::path log = folder / run_folder::log_file(service);
    std::ofstream(log, std::ios::app) << "[skein] the container was started again at " << now->second
                                      << "; what it wrote since then:\n";
    const std::string into = " 2>>" + shell_word(log) + (foreign.contains(service) ? " >&2)" : ")");
    shell("(docker logs --since " + shell_word(now->second) + " " + id + into);
  }
}

std::map<std::string, std::string> ComposeProject::containers() const {
  const ScratchDir scratch;
  const fs::path list = scratch.path() / "containers";
  shell("docker ps --all --filter label=com.docker.compose.project=" + shell_word(name_) +
            " --format '{{.Label \"com.docker.compose.service\"}} {{.ID}}'",
        list);
  std::map<std::string, std::string> containers;
  std::ifstream in(list);
  for (std::string service, id; in >> service >> id;) containers[service] = id;
  return containers;
}

}  // namespace skein::cli
