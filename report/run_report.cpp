#include "report/run_report.hpp"

#include "process/files/atomic_file.hpp"
#include "report/html.hpp"
#include "report/page_data.hpp"
#include "report/page_parts.hpp"
#include "report/web_bundle.hpp"
#include "results/run_folder.hpp"

namespace skein::report {
namespace {

std::string footer(const results::RunRecord& run, const std::optional<std::string>& bundle) {
  std::string html = "<footer class=\"soft\">";
  if (!bundle) {
    html +=
        "<p id=\"static\">The drawings of this page are not interactive, because the script report.js was missing when "
        "it was made. Packages of Skein contain it; a build from source makes it with npm (docs/report.md). "
        "<code>skein report</code> with this folder makes the page again.</p>";
  }
  return html + "<p>Skein " + escaped(text_in(run.result, "skein_version")) +
         ". All figures are from the tables beside this page: result.json, losses.csv, captures.csv, events.csv, "
         "score_timeline.csv, trajectories.csv, activity.csv and scene.json.</p></footer>\n";
}

}  // namespace

std::string run_page(results::RunRecord data, const std::optional<std::string>& bundle) {
  const RunPage page(std::move(data));
  const std::string title = text_in(page.run.result, "scenario") + " by " + planners_of(page.run.result);
  std::string html = page_begin(title, bundle, "run");
  html += head_section(page) + "<div class=\"pair\">" + losses_section(page) + timeline_section(page) + "</div>\n" +
          views_section(page) + places_section(page) + maps_section(page) + boxes_section(page) + fleet_section(page) +
          radio_section(page) + machine_section(page) + footer(page.run, bundle) + "</main>\n";
  if (bundle) {
    const std::string json = page_data(page).dump(-1, ' ', false, Json::error_handler_t::replace);
    html += "<script type=\"application/json\" id=\"data\">" + script_json(json) + "</script>\n<script>" + *bundle +
            "</script>\n";
  }
  return html + "</body>\n</html>\n";
}

void write_run_report(const std::filesystem::path& dir) {
  write_file_atomically(dir / run_folder::kPage, run_page(results::read_sound_run(dir), web_bundle()));
}

}  // namespace skein::report
