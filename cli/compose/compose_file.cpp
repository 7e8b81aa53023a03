#include "cli/compose/compose_file.hpp"

#include <arpa/inet.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "cli/compose/agents_folder.hpp"
#include "cli/compose/compose_checks.hpp"
#include "cli/compose/compose_header.hpp"
#include "cli/compose/compose_networks.hpp"
#include "cli/compose/compose_yaml.hpp"
#include "cli/compose/images.hpp"
#include "cli/compose/stack_parts.hpp"
#include "core/config/config_files.hpp"
#include "core/planners/python_spec.hpp"
#include "process/files/security_files.hpp"
#include "process/host/address_text.hpp"
#include "results/run_folder.hpp"
#include "run/exec_variables.hpp"
#include "run/fleet_programs.hpp"
#include "run/live_page.hpp"
#include "run/program_files.hpp"
#include "run/python_planners.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

constexpr const char* kConfigInImage = "/usr/share/skein/config";
constexpr const char* kResultsInContainer = "/results";
constexpr const char* kHealthFile = "/tmp/alive";  ///< in a container; a program touches it while it works
constexpr const char* kKeysInContainer = "/keys";
constexpr const char* kBuildInContainer = "/opt/skein";
constexpr const char* kParametersInContainer = "/planner.yaml";
/// For the page: a folder in the station's container, and the station's name and port in the page's network.
constexpr const char* kViewInContainer = "/view";
constexpr const char* kViewAlias = "page.view";
constexpr int kViewPort = 8080;
constexpr int kLease_s = 10;  ///< without a launcher, only leases tell which program died
/// A container that the engine restarts after the end of the run waits this long for a server, then ends.
constexpr int kServerTimeout_s = 60;
constexpr int kMostRestarts = 5;

/// Variables that docker-compose substitutes when it reads the file.
constexpr const char* kRunVariable = "${SKEIN_RUN:-1}";
constexpr const char* kUserVariable = "${SKEIN_USER:-1000:1000}";

/// Writes a text or, if there is none, a variable that docker-compose substitutes.
void add(ComposeYaml& yaml, const std::optional<std::string>& text, const std::string& variable) {
  if (text) {
    yaml.literal(*text);
  } else {
    yaml.own(variable);
  }
}

/// Writes a mount in the long form, in which paths may contain colons.
void add_mount(ComposeYaml& yaml, const fs::path& here, const fs::path& in_container, bool read_only = true) {
  yaml.begin_map().key("type").own("bind").key("source").literal(here.string());
  yaml.key("target").literal(in_container.string()).key("read_only").flag(read_only).end_map();
}

/// Path in the images of a file that Skein ships; nullopt: Skein does not ship it.
std::optional<fs::path> in_image(const fs::path& file) {
  const fs::path config = fs::weakly_canonical(default_config_dir());
  const fs::path below = fs::weakly_canonical(file).lexically_relative(config);
  if (below.empty() || *below.begin() == "..") return std::nullopt;
  return kConfigInImage / below;
}

/// Path of a file in containers. A file that is not in the image is mounted at the path that it has on this host.
fs::path in_container(const fs::path& file) { return in_image(file).value_or(fs::absolute(file).lexically_normal()); }

/// Files of this host that a program reads, by their paths in its container.
std::map<fs::path, fs::path> files_of(const FleetPlan& plan, const std::string& program) {
  std::map<fs::path, fs::path> mounted;
  for (const fs::path& file : scenario_files(plan, program)) {
    if (!in_image(file)) mounted[in_container(file)] = fs::weakly_canonical(file);
  }
  if (programs::is_agent(program)) {
    const fs::path parameters = parameter_file(planner_of(plan, program));
    if (!parameters.empty()) mounted[kParametersInContainer] = fs::weakly_canonical(parameters);
    if (const auto python = python_spec(planner_of(plan, program).spec)) {
      for (const fs::path& source : python_sources(python->file)) mounted[source] = fs::weakly_canonical(source);
    }
  }
  return mounted;
}

class ComposeText {
 public:
  ComposeText(const FleetPlan& plan, const ComposeLayout& layout) : plan_(plan), layout_(layout), networks_(plan) {}

  std::string text() {
    yaml_.begin_map();
    add_common();
    yaml_.key("services").begin_map();
    for (const char* server : programs::kServers) add_service(server);
    for (const UavConfig& uav : plan_.scenario.fleet) add_service(programs::agent_program(uav.name));
    if (plan_.ground) add_service(programs::kGroundAgent);
    yaml_.end_map();
    add_networks();
    if (!layout_.results) add_volumes();
    sent_.add_sources(yaml_);
    yaml_.end_map();
    return compose_header(plan_.scenario.name, layout_.command) + yaml_.text() + "\n";
  }

 private:
  /// Settings that all programs share. The health check tests whether the program still takes its turns.
  void add_common() {
    if (layout_.stack) yaml_.key("version").own("3.9");
    yaml_.key("x-program").anchor("program").begin_map();
    yaml_.key("init").flag(true).key("user");
    add(yaml_, layout_.user, layout_.stack ? stack_user() : kUserVariable);
    yaml_.key("read_only").flag(true).key("tmpfs").own(Texts{"/tmp"});
    yaml_.key("cap_drop").own(Texts{"ALL"});
    if (!layout_.stack) yaml_.key("security_opt").own(Texts{"no-new-privileges:true"});
    yaml_.key("sysctls").begin_map().key("net.ipv4.ip_forward").own("0").end_map();
    if (!layout_.stack) {
      yaml_.key("dns_opt").own(Texts{"timeout:1", "attempts:1"});
      yaml_.key("pids_limit").number(kMostProcesses);
    }
    yaml_.key("stop_grace_period").own("10s");
    yaml_.key("logging").begin_map().key("driver").own("json-file").key("options").begin_map();
    yaml_.key("max-size").own("64m").key("max-file").own("2").end_map().end_map();
    if (!layout_.stack) add_health_check();
    yaml_.end_map();
  }

  /// Not in a swarm: its DNS does not resolve a service that is not healthy yet, so all programs would wait in vain.
  void add_health_check() {
    yaml_.key("healthcheck").begin_map();
    yaml_.key("test").own(Texts{"CMD-SHELL", fmt::format("find {} -newermt '-20 seconds' | grep -q .", kHealthFile)});
    yaml_.key("interval").own("5s").key("timeout").own("5s");
    yaml_.key("retries").number(3).key("start_period").own("30s").end_map();
  }

  /// Limits, node and restarts of a program. The engine restarts a program that has failed, except sim_server: without
  /// the server the run is over.
  void add_limits(const std::string& program) {
    const bool agent = programs::is_agent(program), server = program == programs::kSimServer;
    const char* const memory = server ? "4g" : "1g";
    if (layout_.stack) {
      const auto node = layout_.nodes.find(program);
      add_deployment(yaml_, {.node = node == layout_.nodes.end() ? "" : node->second,
                             .manager = !agent,
                             .memory = memory,
                             .cpus = agent ? "1" : "",
                             .restarts = server ? 0 : kMostRestarts});
      return;
    }
    yaml_.key("restart").own(server ? "no" : fmt::format("on-failure:{}", kMostRestarts));
    yaml_.key("mem_limit").own(memory);
    if (agent) yaml_.key("cpus").number(1);
  }

  void add_service(const std::string& program) {
    const bool agent = programs::is_agent(program);
    const auto own_image = layout_.images.find(programs::member_name(program));
    const bool foreign = agent && own_image != layout_.images.end();
    yaml_.blank_line().key(program).begin_map().key("<<").alias("program").key("image");
    if (foreign) {
      yaml_.literal(own_image->second);
    } else {
      const auto [usual, variable] = image_of(plan_, program);
      const auto chosen = layout_.chosen.find(variable);
      if (chosen != layout_.chosen.end()) {
        yaml_.literal(chosen->second);
      } else {
        yaml_.own(fmt::format("${{{}:-{}}}", variable, usual));
      }
    }
    add_limits(program);
    yaml_.key("command").begin_list();
    if (!agent) yaml_.own(program);
    for (const std::string& argument : arguments_of(program)) yaml_.literal(argument);
    if (layout_.run) {
      yaml_.literal("--run=" + *layout_.run);
    } else {
      yaml_.own(std::string("--run=") + kRunVariable);
    }
    yaml_.end_list().key("environment").begin_map();
    yaml_.key("SKEIN_NETWORK").literal(networks_.text_for(program));
    if (foreign) add_variables(program);
    yaml_.end_map().key("networks").begin_map();
    for (const std::string& network : networks_.of(program)) {
      yaml_.key(network).begin_map().key("aliases").own(Texts{ComposeNetworks::alias(program, network)}).end_map();
    }
    if (serves_page(program)) {
      yaml_.key(kViewNetwork).begin_map().key("aliases").own(Texts{kViewAlias}).end_map();
    }
    yaml_.end_map();
    if (serves_page(program)) {
      yaml_.key("ports").own(Texts{layout_.view->published.text() + ":" + std::to_string(kViewPort)});
    }
    yaml_.key("volumes").begin_list();
    add_mounts(program);
    yaml_.end_list();
    if (layout_.stack) add_sent_files(program);
    yaml_.end_map();
  }

  bool serves_page(const std::string& program) const { return layout_.view && program == programs::kStation; }
  bool is_debugged(const std::string& program) const {
    return std::ranges::find(plan_.debug, program, &Debuggee::program) != plan_.debug.end();
  }

  Texts arguments_of(const std::string& program) const {
    Texts texts, arguments = program_arguments(plan_, program, kComposeBaseDomain);
    for (const fs::path& path : {plan_.scenario.file, plan_.faults.file, plan_.options.assets.value_or("")}) {
      if (!path.empty()) std::ranges::replace(arguments, fs::absolute(path).string(), in_container(path).string());
    }
    if (programs::is_agent(program)) {
      const std::string spec = planner_of(plan_, program).spec, file = parameter_file(planner_of(plan_, program));
      if (!file.empty()) {
        std::ranges::replace(arguments, spec, spec.substr(0, spec.size() - file.size()) + kParametersInContainer);
      }
    }
    arguments.insert(arguments.end(),
                     {"--keep", "--lease",
                      std::to_string(plan_.options.lease_s.value_or(plan_.debug.empty() ? kLease_s : kLongestLease_s)),
                      "--server-timeout", std::to_string(kServerTimeout_s), "--out", kResultsInContainer});
    if (!layout_.stack) arguments.insert(arguments.end(), {"--health", kHealthFile});
    if (is_debugged(program)) arguments.push_back("--wait-for-debugger");
    if (plan_.options.secure) arguments.insert(arguments.end(), {"--security", kKeysInContainer});
    if (serves_page(program)) {
      const fs::path folder = kViewInContainer;
      arguments.insert(arguments.end(), {"--view-listen", kViewAlias + (":" + std::to_string(kViewPort)), "--view-key",
                                         folder / kViewKey, "--view-script", folder / kViewScript, "--view-title",
                                         plan_.scenario.name + " by " + plan_.options.planner});
      for (const std::string& name : layout_.view->names) arguments.insert(arguments.end(), {"--view-name", name});
    }
    if (layout_.status_lines) arguments.insert(arguments.end(), {"--status-fd", "1"});
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const bool has_value = i + 1 < arguments.size() && !arguments[i + 1].starts_with("--");
      texts.push_back(arguments[i] + (has_value ? "=" + arguments[i + 1] : ""));
      i += has_value ? 1 : 0;
    }
    return texts;
  }

  /// Environment of a client that is not Skein's own agent, such as a ROS 2 node.
  void add_variables(const std::string& program) {
    const std::string domain = std::to_string(agent_domain(plan_, program, kComposeBaseDomain));
    for (const auto& [name, value] : {std::pair<std::string, std::string>{"SKEIN_DOMAIN", domain},
                                      {"ROS_DOMAIN_ID", domain},
                                      {"SKEIN_UAV", programs::member_name(program)},
                                      {"SKEIN_DDS", dds_vendors(plan_).at(program)},
                                      {"SKEIN_OUT", kResultsInContainer}}) {
      yaml_.key(name).literal(value);
    }
    for (const auto& [name, value] : part_variables(plan_, program)) yaml_.key(name).literal(value);
    yaml_.key("SKEIN_RUN");
    add(yaml_, layout_.run, kRunVariable);
  }

  void add_mounts(const std::string& program) {
    if (layout_.results) {
      add_mount(yaml_, results_of(program, *layout_.results), kResultsInContainer, false);
    } else {
      yaml_.own(volume_of(program) + ":" + kResultsInContainer);
    }
    for (const auto& [there, here] : files_of(plan_, program)) {
      if (!travels(program)) add_mount(yaml_, here, there);
    }
    if (serves_page(program)) add_mount(yaml_, layout_.view->folder, kViewInContainer);
    if (plan_.options.secure && !layout_.stack) add_mount(yaml_, layout_.keys + "/" + program, kKeysInContainer);
    if (layout_.build && !layout_.images.contains(programs::member_name(program))) {
      add_mount(yaml_, *layout_.build / "bin", fs::path(kBuildInContainer) / "bin");
      add_mount(yaml_, default_config_dir(), fs::path(kBuildInContainer) / "config");
    }
  }
  /// In a stack, Docker sends agents' files to their nodes; the other programs run on a manager, which has the files.
  bool travels(const std::string& program) const { return layout_.stack && programs::is_agent(program); }
  void add_sent_files(const std::string& program) {
    if (travels(program)) sent_.add_configs(yaml_, files_of(plan_, program));
    if (!plan_.options.secure) return;
    std::map<fs::path, fs::path> keys;
    for (const char* file : security_files::kAll) {
      keys[fs::path(kKeysInContainer) / file] = fs::path(layout_.keys) / program / file;
    }
    sent_.add_secrets(yaml_, keys);
  }
  static std::string volume_of(const std::string& program) {
    return programs::is_agent(program) ? "results-" + programs::member_name(program) : "results";
  }

  void add_networks() {
    yaml_.key("networks").begin_map();
    for (const std::string& name : networks_.names()) {
      // The bridge has no address, so containers cannot reach the host through it.
      yaml_.key(name).begin_map().key("internal").flag(true);
      if (layout_.stack) {
        yaml_.key("driver").own("overlay");
      } else {
        add_driver_option("com.docker.network.bridge.inhibit_ipv4", "true");
      }
      add_next_subnet();
      yaml_.end_map();
    }
    if (layout_.view) {  // browsers reach the station through it; without masquerading, the station reaches no host
      yaml_.key(kViewNetwork).begin_map();
      add_driver_option("com.docker.network.bridge.enable_ip_masquerade", "false");
      add_next_subnet();
      yaml_.end_map();
    }
    yaml_.end_map();
  }

  void add_driver_option(const char* name, const char* value) {
    yaml_.key("driver_opts").begin_map().key(name).own(value).end_map();
  }

  void add_next_subnet() {
    if (!layout_.subnet) return;
    const in_addr address{htonl(layout_.subnet->address + (subnets_++ << (32 - kNetworkPrefix)))};
    yaml_.key("ipam").begin_map().key("config").begin_list().begin_map();
    yaml_.key("subnet").own(address_text(address) + "/" + std::to_string(kNetworkPrefix));
    yaml_.end_map().end_list().end_map();
  }

  void add_volumes() {
    Texts names;
    for (const auto& [program, vendor] : dds_vendors(plan_)) names.push_back(volume_of(program));
    std::ranges::sort(names);
    names.erase(std::ranges::unique(names).begin(), names.end());
    yaml_.key("volumes").begin_map();
    for (const std::string& name : names) yaml_.key(name).begin_map().end_map();
    yaml_.end_map();
  }

  const FleetPlan& plan_;
  const ComposeLayout& layout_;
  const ComposeNetworks networks_;
  ComposeYaml yaml_;
  SentFiles sent_;             ///< of a stack
  std::uint32_t subnets_ = 0;  ///< assigned so far
};

}  // namespace

fs::path results_of(const std::string& program, const fs::path& results) {
  return programs::is_agent(program) ? results / kAgentsFolder / programs::member_name(program) : results;
}

std::string compose_file(const FleetPlan& plan, const ComposeLayout& layout) {
  check_layout(plan, layout);
  return ComposeText(plan, layout).text();
}

}  // namespace skein::cli
