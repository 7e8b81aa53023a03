#include "cli/bench/flown.hpp"

#include <sstream>
#include <utility>

#include "cli/bench/report.hpp"
#include "host/preflight.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {

Flown fly(const RunOptions& run) {
  std::ostringstream out, err;
  const int code = run_fleet(run, {out, err, false});
  if (code == kExitInterrupted) throw Interrupted{};
  Json result = read_json(*run.out / run_folder::kResult);
  const bool well = code == kExitDone && ran_to_the_end(result);
  return {std::move(result), well, err.str()};
}

}  // namespace skein::cli
