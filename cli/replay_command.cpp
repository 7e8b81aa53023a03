#include "cli/replay_command.hpp"

#include "cli/run/live_page.hpp"
#include "core/types.hpp"
#include "process/program.hpp"
#include "view/finished_run.hpp"

namespace skein::cli {

int replay_run(const ReplayOptions& options, const Console& console) {
  const std::string title = view::title_of_run(options.run);
  const LivePage page(options.port);
  console.out << title << "; " << page.address() << "; Ctrl-C ends it" << std::endl;
  page.replay(options.run);
  return kExitDone;
}

}  // namespace skein::cli
