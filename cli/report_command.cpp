#include "cli/report_command.hpp"

#include "process/program.hpp"
#include "process/run_folder.hpp"
#include "report/run_report.hpp"

namespace skein::cli {

int make_reports(const ReportOptions& options, const Console& console) {
  for (const std::filesystem::path& run : options.runs) {
    report::write_run_report(run);
    console.out << (run / run_folder::kPage).string() << std::endl;
  }
  return kExitDone;
}

}  // namespace skein::cli
