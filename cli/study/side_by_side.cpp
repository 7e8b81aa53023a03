#include "cli/study/side_by_side.hpp"

#include <algorithm>
#include <cstdlib>

#include "cli/run_arguments.hpp"
#include "host/threads.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

ProgramSpec flight_program(const RunOptions& run, const std::map<std::string, std::string>& variables) {
  std::vector<std::string> argv = flight_words(run);
  argv.insert(argv.begin(), program_dir() / "skein");
  return {"", std::move(argv), environment_with(variables), *run.out / run_folder::kFlightLog};
}

bool SideBySide::fly(std::deque<std::size_t> waiting, const Start& start, const Over& over) {
  for (;;) {
    while (!interrupted_ && running_.size() < at_once_ && !waiting.empty()) {
      std::optional<ProgramSpec> program = start(waiting.front());
      if (!program) break;
      program->name = "flight " + std::to_string(waiting.front());
      if (std::getenv(kThreadsVariable) == nullptr) {  // else the flights inherit it
        const std::size_t beside = std::min(at_once_, running_.size() + waiting.size());
        program->env.push_back(std::string(kThreadsVariable) + "=" + std::to_string(threads_beside(beside)));
      }
      supervisor_.start(*program);
      running_[program->name] = waiting.front();
      waiting.pop_front();
    }
    if (running_.empty()) return !interrupted_;
    for (const Event& event : supervisor_.wait(std::chrono::milliseconds(-1))) {
      if (event.kind == Event::Kind::interrupt) on_interrupt();
      if (event.kind != Event::Kind::exited) continue;
      const std::size_t index = running_.extract(event.program).mapped();
      interrupted_ = interrupted_ || event.exit.code == kExitInterrupted;
      if (!interrupted_ || event.exit.ok()) over(index, event.exit);
    }
  }
}

void SideBySide::on_interrupt() {
  if (!interrupted_) {
    console_.err << "ending the current flights; press Ctrl-C again to end them immediately" << std::endl;
  }
  interrupted_ = true;
  for (const auto& [name, index] : running_) supervisor_.signal(name, SIGINT);
}

}  // namespace skein::cli
