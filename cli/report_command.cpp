#include "cli/actions.hpp"

#include "process/program.hpp"
#include "report/run_report.hpp"
#include "results/run_folder.hpp"
#include "run/recording.hpp"

namespace skein::cli {

int make_reports(const ReportOptions& options, const Console& console) {
  int code = kExitDone;
  for (const std::filesystem::path& run : options.runs) {
    report::write_run_report(run);
    console.out << (run / run_folder::kPage).string() << std::endl;
    // The page is made from the tables, so a damaged recording does not affect it; the user should know all the same.
    for (const std::string& damage : recording_damage(run)) {
      console.err << damage << std::endl;
      code = kExitCheckFailed;
    }
  }
  return code;
}

}  // namespace skein::cli
