#include "cli/bench/flown.hpp"

#include <sstream>

#include "cli/bench/report.hpp"
#include "cli/run_command.hpp"
#include "host/preflight.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {

Json fly(const RunOptions& run, const std::string& what, std::ostream& err, bool& failed) {
  std::ostringstream out, said;
  const int code = run_fleet(run, {out, said, false});
  if (code == kExitInterrupted) throw Interrupted{};
  Json result = read_json(*run.out / run_folder::kResult);
  if (code != kExitDone || !ran_to_the_end(result)) {
    failed = true;
    err << "bench: " << what << " did not go well:\n" << said.str() << std::endl;
  }
  return result;
}

}  // namespace skein::cli
