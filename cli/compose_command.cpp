#include "cli/compose_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "cli/compose/agents_folder.hpp"
#include "cli/compose/compose_file.hpp"
#include "cli/compose/compose_header.hpp"
#include "cli/compose/engine.hpp"
#include "cli/compose/followers.hpp"
#include "cli/compose/images.hpp"
#include "cli/keys_command.hpp"
#include "cli/option_checks.hpp"
#include "cli/place/placement.hpp"
#include "cli/run_results.hpp"
#include "host/preflight.hpp"
#include "process/files/atomic_file.hpp"
#include "process/files/private_file.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_programs.hpp"
#include "run/inputs_outlast.hpp"
#include "run/live_page.hpp"
#include "run/open_files.hpp"
#include "run/results_dir.hpp"
#include "view/pages.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// Port of the page of a fleet that is started from a written file, unless --view names another.
constexpr std::uint16_t kPortOfAFile = 8080;
/// The user under whom the containers' programs run when the launcher is root.
constexpr UserId kOrdinaryUser{1000, 1000};
// Files of the launcher in the results folder.
constexpr const char* kComposeFile = "compose.yaml";
constexpr const char* kComposeLog = "compose.log";

ComposeLayout layout_of(const ComposeOptions& options) {
  ComposeLayout layout;
  layout.command = options.run.command;
  for (const std::string& image : options.images) {
    const std::size_t equals = image.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == image.size()) {
      throw InputError("--image " + image + ": must be UAV=IMAGE");
    }
    layout.images[image.substr(0, equals)] = image.substr(equals + 1);
  }
  layout.stack = options.stack;
  if (options.stack && options.run.view.at) {
    throw InputError("--stack and --view: a fleet over several engines has no live page; leave out one of them");
  }
  if (options.stack && options.build) {
    throw InputError("--stack and --build-folder: other nodes have no such folder; leave out one of them");
  }
  if (options.subnet) layout.subnet = parse_subnet(*options.subnet);
  if (options.run.view.at) {
    ComposeView& view = layout.view.emplace();
    view.published = view::read_endpoint(*options.run.view.at);
    if (view.published.port == 0 && !options.up) view.published.port = kPortOfAFile;
    if (!view.published.is_loopback()) view.names = view::names_of(view.published);
  }
  if (options.build) {
    layout.build = fs::absolute(*options.build).lexically_normal();
    if (!fs::exists(*layout.build / "bin" / programs::kSimServer)) {
      throw InputError("--build-folder " + options.build->string() + ": there is no bin/" + programs::kSimServer +
                       " in it");
    }
  }
  return layout;
}

std::string variable_or(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

/// The folders that the programs in containers write to, and the user under whom they write.
class ContainerFolders {
 public:
  explicit ContainerFolders(const fs::path& out)
      : out_(out), user_(::geteuid() == 0 ? kOrdinaryUser : UserId{::getuid(), ::getgid()}) {}

  std::string user() const { return fmt::format("{}:{}", user_.uid, user_.gid); }
  void give(const fs::path& path) const {
    if (::geteuid() == 0 && ::lchown(path.c_str(), user_.uid, user_.gid) != 0) {
      throw std::system_error(errno, std::generic_category(), path.string());
    }
  }
  void give_all(const fs::path& folder) const {
    for (const auto& entry : fs::directory_iterator(folder)) give(entry.path());
    give(folder);
  }
  void make(const FleetPlan& plan) const {
    fs::remove_all(out_ / kAgentsFolder);
    give(out_);
    for (const auto& [program, vendor] : dds_vendors(plan)) {
      fs::create_directories(results_of(program, out_));
      give(results_of(program, out_));
    }
  }

 private:
  const fs::path out_;
  const UserId user_;
};

/// Files and folders of a fleet in containers that no run without containers has. Without --force, a run neither
/// overwrites nor deletes them, no matter which program made them. @throws InputError
void check_no_containers_files(const fs::path& dir) {
  for (const char* name : {kComposeFile, kComposeLog, kAgentsFolder}) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(dir / name, error))) continue;
    throw InputError(dir.string() + " holds '" + name +
                     "', a name that a run in containers uses for a file of its own; overwrite it with --force, or "
                     "choose another --out");
  }
}

void check_before_flight(FleetPlan plan, const ComposeLayout& layout, const Console& console) {
  allow_launcher_open_files(plan);
  std::vector<std::string> images;
  for (const auto& [variable, image] : layout.chosen) images.push_back(image);
  for (const auto& [member, image] : layout.images) images.push_back(image);
  check_engine(images);
  for (const Debuggee& one : plan.debug) {
    if (!one.here) continue;
    const auto own = layout.images.find(one.member);
    check_gdb(own != layout.images.end() ? own->second : layout.chosen.at(image_of(plan, one.program).variable),
              one.member);
  }
  // The programs in a user's own image cannot be checked here.
  std::erase_if(plan.planners, [&](const UavPlanner& planner) { return layout.images.contains(planner.uav); });
  if (plan.ground && layout.images.contains("gcs")) plan.ground.reset();
  const ScratchDir scratch;
  run_checks(check_programs(plan, scratch.path()),
             [&](const std::string& waiting) { console.err << waiting << std::endl; });
}

/// Tells the user which programs wait for a debugger, and how to attach one.
void tell_who_waits(const FleetPlan& plan, const std::map<std::string, std::string>& containers, const fs::path& out,
                    ProgressView& view) {
  for (const Debuggee& one : plan.debug) {
    if (one.here || !containers.contains(one.program)) continue;
    view.message(
        fmt::format("{} waits before its first step until you attach to the process that {} names:\n\n  "
                    "docker exec --interactive --tty {} gdb -q -p PROCESS\n",
                    one.member, (out / run_folder::log_file(one.program)).string(), containers.at(one.program)));
  }
}

/// Completes the logs of containers that a user has started again. Ctrl-C skips the rest of this, so that the results
/// are still written.
void add_later_logs(const std::map<std::string, std::string>& containers,
                    const std::map<std::string, std::string>& starts, const ComposeLayout& layout,
                    const fs::path& out) try {
  std::set<std::string> foreign;
  for (const auto& [program, id] : containers) {
    if (layout.images.contains(programs::member_name(program))) foreign.insert(program);
  }
  ComposeProject::add_later_logs(containers, starts, out, foreign);
} catch (const Interrupted&) {
}

/// Flies the fleet of a project that is up.
void fly_in(const ComposeProject& project, const FleetPlan& plan, const ComposeLayout& layout, const fs::path& out,
            FleetRun& run) {
  const std::map<std::string, std::string> containers = project.containers();
  const std::map<std::string, std::string> starts = ComposeProject::starts(containers);
  tell_who_waits(plan, containers, out, run.view());
  run.fly_in_containers(followers(containers, plan, layout, out), out);
  add_later_logs(containers, starts, layout, out);
}

int fly(const ComposeOptions& options, const FleetPlan& plan, ComposeLayout layout, const Console& console) {
  for (const auto& [program, vendor] : dds_vendors(plan)) {
    const auto [image, variable] = image_of(plan, program);
    if (!layout.images.contains(programs::member_name(program))) layout.chosen[variable] = variable_or(variable, image);
  }
  compose_file(plan, layout);                                                // throws if the file cannot be made
  const fs::path planned = results_dir_of(options.run, plan.scenario.name);  // another launcher may take it first
  ResultsDir::check(planned, options.run.force);
  if (!options.run.force) check_no_containers_files(planned);
  check_inputs_outlast(plan, planned);
  check_before_flight(plan, layout, console);
  std::optional<LivePage> page;
  if (layout.view) page.emplace(layout.view->published, true);
  const auto out = ResultsDir::take(options.run, plan.scenario.name);
  const fs::path& dir = out->given();
  if (!options.run.force) check_no_containers_files(dir);
  const ContainerFolders folders(out->path());
  folders.make(plan);
  const ScratchDir keys;
  const std::uint64_t run_id = draw_run_id();
  if (options.run.secure) {
    write_keys(plan, kComposeBaseDomain, keys.path(), [&](const fs::path& path) { folders.give(path); });
    layout.keys = keys.path();
  }
  const ScratchDir shown;
  if (page) {
    write_for_station(shown.path(), page->key());
    folders.give_all(shown.path());
    layout.view->published = page->endpoint();
    layout.view->folder = shown.path();
  }
  layout.results = out->path();
  layout.user = folders.user();
  layout.run = std::to_string(run_id);
  layout.status_lines = true;
  write_file_atomically(out->path() / kComposeFile, compose_file(plan, layout));

  FleetRun run(plan, console.err, console.terminal);
  {
    ComposeProject project(out->path() / kComposeFile, fmt::format("skein-{:08x}", run_id & 0xffffffff),
                           out->path() / kComposeLog, console.err);
    run.view().message(fmt::format("{}: {} UAVs in containers, planner {}, seed {}, results in {}", plan.scenario.name,
                                   plan.scenario.fleet.size(), options.run.planner, options.run.seed, dir.string()));
    project.up();
    if (page) {
      page->announce([&](const std::string& text) { run.view().message(text); },
                     options.run.view.browser && console.terminal);
    }
    fly_in(project, plan, layout, out->path(), run);
  }
  gather_agents(out->path());
  const results::Reports reports = results::read_reports(out->path(), plan.scenario, run.reports());
  const RunResults results{options.run, run.facts(), plan.scenario,
                           reports,     out->path(), [&](const std::string& text) { return out->write_result(text); }};
  const auto result = write_results(
      results, dir, [] { return std::vector<std::string>(); }, console);
  if (!result) return kExitProcessFailed;
  if (page && !run.facts().interrupted) page->stay_as_replay(out->path(), options.run.view, console.err);
  return exit_code_of(run, *result);
}

/// The file that a link leads to, also if it is not there yet: weakly_canonical() would keep the link's own name then.
fs::path behind_links(fs::path path) {
  constexpr int kMostLinks = 40;  // as the kernel
  for (int links = 0; fs::is_symlink(path); ++links) {
    if (links == kMostLinks) throw std::system_error(std::make_error_code(std::errc::too_many_symbolic_link_levels));
    path = path.parent_path() / fs::read_symlink(path);
  }
  return path;
}

/// Writes the file for docker-compose, or leaves the former one as it is. Without `force`, it replaces a file only if
/// that is empty, or `skein compose` made it. @throws InputError
void write_compose_file(const fs::path& path, const std::string& text, bool force) try {
  if (const std::string wrong = check_file_to_write(path); !wrong.empty()) throw InputError("--file: " + wrong);
  std::error_code error;
  const bool holds_something = fs::is_regular_file(path, error) && !fs::is_empty(path, error);
  if (!force && holds_something && !is_compose_file(path)) {
    throw InputError("--file " + path.string() +
                     ": exists already, and `skein compose` did not write it; overwrite it with --force, or choose "
                     "another file");
  }
  replace_or_overwrite(behind_links(path), text);  // a link stays, and leads to the new file
} catch (const std::system_error& error) {
  throw InputError("--file " + path.string() + ": cannot be written: " + error.code().message());
}

/// The folder beside a docker-compose file with the key of the fleet's page, and with the file that opens the page.
fs::path view_folder_of(const fs::path& file) { return fs::path(file).replace_extension(".view"); }

void write_view_folder(const fs::path& folder, const view::Endpoint& published) {
  const view::Key key = view::Key::draw();
  write_for_station(folder, key);
  write_private_file(folder / kViewDoor, view::key_file_page(published.from_here().text(), key, true));
  ContainerFolders(folder).give_all(folder);
}

/// Sets all values of --debug to =wait. At most one may be =gdb; with a terminal, the first one without a tool counts
/// as =gdb. @returns the UAV or server of that one, for gdb in this terminal; empty: none
std::string take_gdb(std::vector<std::string>& values, bool has_terminal) {
  std::string member;
  for (std::string& value : values) {
    const std::size_t equals = value.find('=');
    const std::string name = value.substr(0, equals), how = equals == std::string::npos ? "" : value.substr(equals);
    if (!how.empty() && how != "=wait" && how != "=gdb") {
      throw InputError("--debug " + value + ": a program in a container is debugged by gdb there (" + name +
                       "=gdb), or waits until a debugger is attached (" + name + "=wait)");
    }
    if (how == "=gdb" && !member.empty()) throw InputError("--debug " + value + ": one gdb can have this terminal");
    if (how == "=gdb" || (how.empty() && has_terminal && member.empty())) member = name;
    value = name + "=wait";
  }
  return member;
}

/// Containers do not inherit SKEIN_ASSETS; only scenes from files need what it names.
FleetPlan plan_in_containers(const ComposeOptions& compose, const Console& console) {
  RunOptions options = compose.run;
  const std::string in_gdb = take_gdb(options.debug, compose.up && console.keyboard);
  if (!in_gdb.empty() && !compose.up) {
    throw InputError("--debug " + in_gdb +
                     "=gdb: gdb comes with --up; in a file a program waits for its debugger: " + in_gdb + "=wait");
  }
  if (!options.assets) options.assets = variable_or("SKEIN_ASSETS", "");
  FleetPlan plan = plan_fleet(options, program_dir());
  if (options.view.at) plan.watched.emplace();  // the layout holds the page's endpoint and key
  if (!plan.scenario.scene.family.empty() || plan.options.assets->empty()) plan.options.assets.reset();
  for (Debuggee& one : plan.debug) {
    if (one.member != in_gdb) continue;
    one.how = Debuggee::How::inside;
    one.here = true;
  }
  return plan;
}

}  // namespace

int compose_fleet(const ComposeOptions& options, const Console& console) {
  const FleetPlan plan = plan_in_containers(options, console);
  ComposeLayout layout = layout_of(options);
  for (const PlacedHost& node : read_placement(plan)) {
    for (const std::string& program : node.programs) layout.nodes[program] = node.name;
  }
  if (options.up) return fly(options, plan, layout, console);
  if (layout.view && !options.file)
    throw InputError("--view needs --up or --file: the page's key lies beside the file");
  if (layout.view) layout.view->folder = "./" + view_folder_of(*options.file).filename().string();
  const std::string text = compose_file(plan, layout);
  if (!options.file) {
    console.out << text << std::flush;
    return kExitDone;
  }
  write_compose_file(*options.file, text, options.run.force);
  if (layout.view) {
    const fs::path folder = view_folder_of(*options.file);
    write_view_folder(folder, layout.view->published);
    console.err << "once the fleet is up, open " << (folder / kViewDoor).string() << " in a browser (http://"
                << layout.view->published.from_here().text() << "/)" << std::endl;
  }
  return kExitDone;
}

}  // namespace skein::cli
