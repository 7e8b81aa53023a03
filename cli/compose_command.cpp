#include "cli/compose_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "cli/compose/agents_folder.hpp"
#include "cli/compose/compose_file.hpp"
#include "cli/compose/engine.hpp"
#include "cli/run/preflight.hpp"
#include "cli/run/results_dir.hpp"
#include "cli/run_results.hpp"
#include "cli/secure/security.hpp"
#include "process/environment.hpp"
#include "process/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImage = "skein";
constexpr const char* kAgentImage = "skein-agent";
/// Whose containers' programs are when the launcher is root.
constexpr UserId kOrdinaryUser{1000, 1000};

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
  if (options.subnet) layout.subnet = parse_subnet(*options.subnet);
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

/// What the programs in containers write to, and as whom.
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

/// A folder of keys for each program.
void write_keys(const FleetPlan& plan, int base_domain, const fs::path& folder,
                const std::function<void(const fs::path&)>& give) {
  for (const auto& [program, files] : security_of(plan, base_domain)) {
    fs::create_directories(folder / program);
    fs::permissions(folder / program, fs::perms::owner_all);
    for (const auto& [name, text] : files) {
      write_private_file(folder / program / name, text);
      give(folder / program / name);
    }
    give(folder / program);
  }
}

/// What follows a container here: hears its status lines on its standard output, keeps the rest as its log, passes a
/// SIGTERM on and ends as it does, or by kEngineLost. The signal is for the whole group, so what listens is in another
/// one.
std::string follower(const std::string& container, bool tells_status) {
  return "trap 'docker kill --signal=TERM " + container + " >/dev/null 2>&1' TERM\n" + "setsid docker logs --follow " +
         container + (tells_status ? " >&3" : "") + " &\nwait $!\nwait\ncode=$(docker wait " + container +
         ")\n[ -n \"$code\" ] || kill -" + std::to_string(kEngineLost) + " $$\nexit \"$code\"";
}

std::vector<ProgramSpec> followers(const ComposeProject& project, const ComposeLayout& layout, const fs::path& out) {
  std::vector<ProgramSpec> programs;
  for (const auto& [program, id] : project.containers()) {
    const bool ours = !layout.images.contains(programs::member_name(program));
    programs.push_back(
        {program, {"/bin/sh", "-c", follower(id, ours)}, environment_with({}), out / run_folder::log_file(program)});
    if (ours) programs.back().most_status_bytes = std::numeric_limits<std::uint64_t>::max();
  }
  // As under the launcher: those that every fleet has one of come first.
  const auto rank = [](const ProgramSpec& program) { return std::ranges::find(programs::kServers, program.name); };
  std::ranges::stable_sort(programs, {}, rank);
  return programs;
}

void check_before_flight(FleetPlan plan, const ComposeLayout& layout, const Console& console) {
  std::vector<std::string> images = {layout.image.value(), layout.agent_image.value()};
  for (const auto& [member, image] : layout.images) images.push_back(image);
  check_engine(images);
  // Of a user's image nothing is known here.
  std::erase_if(plan.planners, [&](const UavPlanner& planner) { return layout.images.contains(planner.uav); });
  if (plan.ground && layout.images.contains("gcs")) plan.ground.reset();
  const ScratchDir scratch;
  run_checks(check_programs(plan, scratch.path()),
             [&](const std::string& waiting) { console.err << waiting << std::endl; });
}

int fly(const ComposeOptions& options, const FleetPlan& plan, ComposeLayout layout, const Console& console) {
  const fs::path usual = default_results_dir(plan.scenario.name, options.run.planner, options.run.seed);
  const fs::path dir = options.run.out.value_or(options.run.force ? usual : free_results_dir(usual));
  layout.image = variable_or("SKEIN_IMAGE", kImage);
  layout.agent_image = variable_or("SKEIN_AGENT_IMAGE", kAgentImage);
  compose_file(plan, layout);  // whether it can be
  ResultsDir::check(dir, options.run.force);
  check_before_flight(plan, layout, console);
  const ResultsDir out(dir, options.run.force);
  const ContainerFolders folders(out.path());
  folders.make(plan);
  const ScratchDir keys;
  const std::uint64_t run_id = draw_run_id();
  if (options.run.secure) {
    write_keys(plan, kComposeBaseDomain, keys.path(), [&](const fs::path& path) { folders.give(path); });
    layout.keys = keys.path();
  }
  layout.results = out.path();
  layout.user = folders.user();
  layout.run = std::to_string(run_id);
  layout.status_lines = true;
  std::ofstream(out.path() / "compose.yaml") << compose_file(plan, layout);

  FleetRun run(plan, console.err, console.terminal);
  {
    ComposeProject project(out.path() / "compose.yaml", fmt::format("skein-{:08x}", run_id & 0xffffffff),
                           out.path() / "compose.log", console.err);
    run.view().message(fmt::format("{}: {} UAVs in containers, planner {}, seed {}, results in {}", plan.scenario.name,
                                   plan.scenario.fleet.size(), options.run.planner, options.run.seed, dir.string()));
    project.up();
    run.fly_in_containers(followers(project, layout, out.path()), out.path());
  }
  gather_agents(out.path());
  const Reports reports = read_reports(out.path(), plan.scenario, run.reports());
  const RunResults results{options.run, run.facts(), plan.scenario,
                           reports,     out.path(),  [&](const std::string& text) { return out.write_result(text); }};
  const auto result = write_results(
      results, dir, [] { return std::vector<std::string>(); }, console);
  return result ? exit_code_of(run, *result) : kExitProcessFailed;
}

/// Containers do not inherit SKEIN_ASSETS; only scenes from files need what it names. And they have no terminal: a
/// debugger comes to the program.
FleetPlan plan_in_containers(RunOptions options) {
  for (std::string& debugged : options.debug) {
    const std::size_t equals = debugged.find('=');
    if (equals != std::string::npos && debugged.substr(equals) != "=wait") {
      throw InputError("--debug " + debugged + ": a container waits until a debugger is attached; say only the name, " +
                       debugged.substr(0, equals));
    }
    if (equals == std::string::npos) debugged += "=wait";
  }
  if (!options.assets) options.assets = variable_or("SKEIN_ASSETS", "");
  FleetPlan plan = plan_fleet(options, program_dir());
  if (!plan.scenario.scene.family.empty() || plan.options.assets->empty()) plan.options.assets.reset();
  return plan;
}

}  // namespace

int compose_fleet(const ComposeOptions& options, const Console& console) {
  const FleetPlan plan = plan_in_containers(options.run);
  const ComposeLayout layout = layout_of(options);
  if (options.up) return fly(options, plan, layout, console);
  const std::string text = compose_file(plan, layout);
  if (!options.file) {
    console.out << text << std::flush;
    return kExitDone;
  }
  std::ofstream file(*options.file, std::ios::binary);
  if (!(file << text << std::flush)) throw InputError("--file " + options.file->string() + ": cannot be written");
  return kExitDone;
}

int make_keys(const KeysOptions& options, const Console& console) {
  RunOptions run = options.run;
  run.secure = true;
  const FleetPlan plan = plan_fleet(run, program_dir());
  std::error_code error;
  if (!fs::create_directories(options.out, error)) {
    throw InputError("--out " + options.out.string() + ": " +
                     (error ? error.message() : "is there already; keys are never overwritten"));
  }
  write_keys(plan, run.domain.value_or(kComposeBaseDomain), options.out, [](const fs::path&) {});
  console.out << "keys of " << domain_count(plan) + 1 << " programs in " << options.out.string()
              << "; whoever has a folder is that program" << std::endl;
  return kExitDone;
}

}  // namespace skein::cli
