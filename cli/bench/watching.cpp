#include "cli/bench/watching.hpp"

#include <spdlog/fmt/fmt.h>

#include <string>

#include "cli/bench/report.hpp"
#include "core/files/command_file.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"
#include "view/pages.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWatchedScenario = "towers";
constexpr const char* kWatchedPlanner = "kios";  // takes and delivers pictures all the time
constexpr double kWatchedS = 120.0, kQuickWatchedS = 40.0;
constexpr int kPairs = 5, kQuickPairs = 1;

/// The programs and files that drive the browser.
struct Tools {
  fs::path node, chromium, web, script;
};

Tools find_tools() {
  const fs::path tree = fs::absolute(view::find_script()).parent_path().parent_path().parent_path();
  const Tools tools{command_file("node"), command_file("chromium"), tree / "web", tree / "bench/view/watched_run.mjs"};
  if (tools.node.empty()) throw InputError("bench --view: there is no Node.js: apt-get install nodejs");
  if (tools.chromium.empty()) throw InputError("bench --view: there is no Chromium: apt-get install chromium");
  for (const fs::path& needed : {tools.script, tools.web / "node_modules/puppeteer-core"}) {
    if (fs::exists(needed)) continue;
    throw InputError("bench --view: " + needed.string() +
                     " is missing: it needs the source tree, and there `npm ci && npm run build` in web/");
  }
  return tools;
}

class WatchingBench {
 public:
  WatchingBench(const BenchOptions& options, const Console& console)
      : options_(options), console_(console), tools_(find_tools()) {}

  int run() {
    const int repeats = options_.repeats.value_or(options_.quick ? kQuickPairs : kPairs);
    std::vector<WatchedPair> pairs;
    for (int i = 0; i < repeats; ++i) {
      console_.err << "bench: watched run " << i + 1 << " of " << repeats << std::endl;
      WatchedPair pair;
      pair.unseen = fly("none", pair.page);
      pair.watched = fly("page", pair.page);
      pairs.push_back(pair);
    }
    const Json entry = watching_entry(pairs);
    print_watching(console_.out, entry);
    if (options_.json) replace_or_overwrite(*options_.json, entry.dump(2) + "\n");
    return failed_ ? kExitProcessFailed : kExitDone;
  }

 private:
  /// One `skein run --view`. @param shown  what the browser shows: "page" or "none". @returns its result.json.
  Json fly(const std::string& shown, Json& page) {
    const fs::path out = scratch_.path() / "run", log = scratch_.path() / run_folder::log_file("view");
    const double flight_s = options_.duration_s.value_or(options_.quick ? kQuickWatchedS : kWatchedS);
    std::vector<std::string> argv = {tools_.node,
                                     tools_.script,
                                     tools_.web,
                                     tools_.chromium,
                                     shown,
                                     out,
                                     program_dir() / "skein",
                                     "run",
                                     options_.scenarios.empty() ? kWatchedScenario : options_.scenarios.front(),
                                     "--planner",
                                     kWatchedPlanner,
                                     "--duration",
                                     fmt::format("{}", flight_s),
                                     "--dds",
                                     options_.dds,
                                     "--out",
                                     out,
                                     "--force",
                                     "--no-oracle",
                                     "--no-report",
                                     "--view",
                                     "--view-close"};
    if (options_.assets) argv.insert(argv.end(), {"--assets", *options_.assets});
    const ExitStatus exit = run_to_end({"view", argv, fleet_environment(false), log});
    const std::vector<std::string> last = last_lines(log, 1);
    page = last.empty() ? Json() : Json::parse(last.front(), nullptr, false);
    const Json result = read_json(out / run_folder::kResult);
    if (!exit.ok() || !page.is_object() || !ran_to_the_end(result)) {
      failed_ = true;
      console_.err << "bench: a watched run did not go well: " << exit.text() << '\n';
      for (const std::string& line : last_lines(log, 20)) console_.err << line << '\n';
    }
    return result;
  }

  const BenchOptions& options_;
  const Console console_;
  const Tools tools_;
  const ScratchDir scratch_;
  bool failed_ = false;
};

}  // namespace

Json watching_entry(const std::vector<WatchedPair>& pairs) {
  std::vector<double> ratios;
  for (const WatchedPair& pair : pairs) {
    const double without_s = fleet_cpu_s(pair.unseen), with_s = fleet_cpu_s(pair.watched);
    if (without_s > 0.0 && with_s > 0.0) ratios.push_back(with_s / without_s);
  }
  const auto figure_or_null = [](const std::vector<double>& values) {
    return values.empty() ? Json() : figure(values);
  };
  Json entry = {{"pairs", pairs.size()}, {"cpu_ratio", figure_or_null(ratios)}};
  for (const auto& [name, key] :
       {std::pair{"first_picture_ms", "first_picture_ms"}, std::pair{"script_ms", "script_ms"},
        std::pair{"thread_ms", "thread_ms"}, std::pair{"draw_calls", "draw_calls"}, std::pair{"pictures", "frames"}}) {
    std::vector<double> values;
    for (const WatchedPair& pair : pairs) {
      const Json value = value_or(pair.page, key, Json());
      if (value.is_number()) values.push_back(value.get<double>());
    }
    entry[name] = figure_or_null(values);
  }
  return entry;
}

void print_watching(std::ostream& out, const Json& entry) {
  struct Row {
    const char* key;
    const char* text;
    const char* target;
    int digits;
  };
  constexpr Row kRows[] = {
      {"cpu_ratio", "CPU time of the fleet, with a page open over without", "1.03", 3},
      {"first_picture_ms", "first picture after the first step [ms]", "2000", 0},
      {"script_ms", "script a picture [ms]", "4", 2},
      {"thread_ms", "all work of the page's thread a picture [ms]", "-", 2},
      {"draw_calls", "draw calls a picture, at most", "50", 0},
      {"pictures", "pictures", "-", 0},
  };
  out << fmt::format("\n{:<56}{:>9}{:>9}{:>9}{:>9}\n", "the live page", "median", "least", "most", "target");
  for (const Row& row : kRows) {
    const Json figures = value_or(entry, row.key, Json());
    const auto cell = [&](const char* name) {
      return figures.is_object() ? fmt::format("{:.{}f}", number_in(figures, name), row.digits) : std::string("-");
    };
    out << fmt::format("{:<56}{:>9}{:>9}{:>9}{:>9}\n", row.text, cell("median"), cell("min"), cell("max"), row.target);
  }
}

int bench_watching(const BenchOptions& options, const Console& console) {
  return WatchingBench(options, console).run();
}

}  // namespace skein::cli
