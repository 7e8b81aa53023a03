#include "cli/preflight.hpp"

#include <spdlog/fmt/fmt.h>

#include <cstdlib>
#include <map>
#include <stdexcept>

#include "core/suggestion.hpp"
#include "core/types.hpp"
#include "core/wait_notice.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kMessageLines = 20;
constexpr std::chrono::milliseconds kGrace{2000};

std::string message_of(const ProgramSpec& program) {
  std::string text;
  for (const std::string& line : last_lines(program.log, kMessageLines)) text += (text.empty() ? "" : "\n") + line;
  return text;
}

/// Runs programs side by side until the last has ended.
std::map<std::string, ExitStatus> run_all(const std::vector<ProgramSpec>& programs, const TellWaiting& tell) {
  Supervisor supervisor;
  for (const ProgramSpec& program : programs) supervisor.start(program);
  std::map<std::string, ExitStatus> exits;
  WaitNotice notice(WaitNotice::Clock::now());
  while (!supervisor.running().empty()) {
    const auto waited_s = notice.due(WaitNotice::Clock::now());
    if (tell && waited_s) {
      tell(fmt::format("waiting for {} to check its input ({:.0f} s)", joined(supervisor.running()), *waited_s));
    }
    for (const Event& event : supervisor.wait(notice.left(WaitNotice::Clock::now()))) {
      if (event.kind == Event::Kind::interrupt) {
        supervisor.end_all(kGrace);
        throw Interrupted{};
      }
      if (event.kind == Event::Kind::exited) exits[event.program] = event.exit;
    }
  }
  return exits;
}

}  // namespace

std::vector<std::string> run_checks(const std::vector<ProgramSpec>& programs, const TellWaiting& tell) {
  const std::map<std::string, ExitStatus> exits = run_all(programs, tell);
  std::vector<std::string> warnings;
  for (const ProgramSpec& program : programs) {
    const ExitStatus exit = exits.at(program.name);
    if (exit.code == 2) throw InputError(message_of(program));
    if (!exit.ok()) {
      throw std::runtime_error(program.name + " --check ended with " + exit.text() + "\n" + message_of(program));
    }
    for (std::string& line : last_lines(program.log, kMessageLines)) {
      if (line.find("] warning ") != std::string::npos) warnings.push_back(std::move(line));
    }
  }
  return warnings;
}

ExitStatus run_to_end(const ProgramSpec& program) { return run_all({program}, {}).at(program.name); }

ScratchDir::ScratchDir() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  std::string name = folder / "skein-XXXXXX";
  if (error || ::mkdtemp(name.data()) == nullptr) {
    const char* named = std::getenv("TMPDIR");
    throw InputError(std::string("TMPDIR") + (named ? std::string("=") + named : " (not set: /tmp)") +
                     ": must be a folder in which files can be made");
  }
  path_ = name;
}

ScratchDir::~ScratchDir() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace skein::cli
