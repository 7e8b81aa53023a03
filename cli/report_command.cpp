#include "cli/report_command.hpp"

#include <CLI/CLI.hpp>

#include "process/program.hpp"
#include "report/run_report.hpp"
#include "results/run_folder.hpp"
#include "run/recording.hpp"

namespace skein::cli {

void add_report(CLI::App& app, ReportOptions& report) {
  CLI::App* command = app.add_subcommand("report", "Write report.html of finished runs again");
  command->add_option("RUN", report.runs, "Results folders")->required();
  command->footer("Example:\n  skein report runs/towers-kios-0\n\nSee docs/report.md.");
}

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
