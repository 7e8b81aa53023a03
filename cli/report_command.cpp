#include "cli/report_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/tell_errors.hpp"
#include "process/program.hpp"
#include "report/run_report.hpp"
#include "results/run_folder.hpp"
#include "results/run_record.hpp"
#include "run/recording.hpp"

namespace skein::cli {
namespace {

int write_page(const std::filesystem::path& run, const Console& console) {
  report::write_run_report(run);
  console.out << (run / run_folder::kPage).string() << std::endl;
  // The page reads around damaged tables, and does not need the recording; the user should know all the same.
  std::vector<std::string> damage = recording_damage(run);
  for (const std::string& sentence : results::damaged_files(run)) damage.push_back(run.string() + ": " + sentence);
  for (const std::string& one : damage) console.err << one << std::endl;
  return damage.empty() ? kExitDone : kExitCheckFailed;
}

}  // namespace

void add_report(CLI::App& app, ReportOptions& report) {
  CLI::App* command = app.add_subcommand("report", "Write report.html of finished runs again");
  command->add_option("RUN", report.runs, "Results folders")->required();
  command->footer("Example:\n  skein report runs/towers-kios-0\n\nSee docs/report.md.");
}

int make_reports(const ReportOptions& options, const Console& console) {
  int worst = kExitDone;
  for (const std::filesystem::path& run : options.runs) {
    worst = std::max(worst, tell_errors(console, [&] { return write_page(run, console); }));
  }
  return worst;
}

}  // namespace skein::cli
