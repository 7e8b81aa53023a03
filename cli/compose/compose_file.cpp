#include "cli/compose/compose_file.hpp"

#include <arpa/inet.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "cli/compose/agents_folder.hpp"
#include "core/config_files.hpp"
#include "core/suggestion.hpp"
#include "core/topics.hpp"
#include "process/json_text.hpp"
#include "process/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConfigInImage = "/usr/share/skein/config";
constexpr const char* kResultsInContainer = "/results";
constexpr const char* kKeysInContainer = "/keys";
constexpr const char* kBuildInContainer = "/opt/skein";
constexpr const char* kParametersInContainer = "/planner.yaml";
/// A network's members (at most four), the engine's own address, the first and the last.
constexpr int kNetworkPrefix = 28;
/// Without a launcher this tells who died; whoever is stopped for longer has to join anew.
constexpr int kLease_s = 10;
constexpr int kDebuggedLease_s = 3600;  ///< the longest that Cyclone DDS takes: who is debugged stands for long
/// A container that the engine has started again once the run was over ends after so long.
constexpr int kServerTimeout_s = 60;

/// What stays the same for all programs. The health check asks whether the program still takes its turns.
constexpr const char* kCommon = R"(
x-program: &program
  init: true
  user: "{user}"
  read_only: true
  tmpfs:
    - /tmp
  cap_drop:
    - ALL
  security_opt:
    - no-new-privileges:true
  sysctls:
    net.ipv4.ip_forward: "0"
  dns_opt:
    - timeout:1
    - attempts:1
  pids_limit: 256
  stop_grace_period: 10s
  healthcheck:
    test: ["CMD-SHELL", "find /tmp/alive -newermt '-20 seconds' | grep -q ."]
    interval: 5s
    timeout: 5s
    retries: 3
    start_period: 30s
)";

/// YAML reads JSON's texts; what docker-compose would take for a variable is not one.
std::string in_quotes(const std::string& text) { return Json(text).dump(); }
std::string literal(const Json& value) {
  std::string text = value.dump();
  for (std::size_t at = 0; (at = text.find('$', at)) != std::string::npos; at += 2) text.insert(at, "$");
  return text;
}
/// The long form of a mount, whose paths may hold colons.
std::string mount(const fs::path& here, const fs::path& in_container, bool read_only = true) {
  return literal(
      {{"type", "bind"}, {"source", here.string()}, {"target", in_container.string()}, {"read_only", read_only}});
}

/// What a program is called in the networks that it is in: "uav.jurong".
std::string role_of(const std::string& program) {
  if (program == programs::kSimServer) return "sim";
  if (program == programs::kCommRouter) return "router";
  if (program == programs::kStation) return "station";
  return program == programs::kGroundAgent ? "program" : "uav";
}

/// Of each domain, by name: who is in it.
class Networks {
 public:
  explicit Networks(const FleetPlan& plan) : names_(domain_names(plan.scenario)) {
    for (const auto& [program, vendor] : dds_vendors(plan)) {
      const bool everywhere = program == programs::kSimServer || program == programs::kCommRouter;
      for (const std::string& name : names_) {
        const bool stations = program == programs::kStation && (name == names_[0] || name == names_[1]);
        if (everywhere || stations || programs::member_name(program) == name) members_[name].push_back(program);
      }
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  std::vector<std::string> of(const std::string& program) const {
    std::vector<std::string> networks;
    std::ranges::copy_if(names_, std::back_inserter(networks), [&](const std::string& name) {
      return std::ranges::find(members_.at(name), program) != members_.at(name).end();
    });
    return networks;
  }
  /// As --network takes it.
  std::string text_for(const std::string& program) const {
    std::string text;
    for (const std::string& name : of(program)) {
      std::vector<std::string> peers;
      for (const std::string& member : members_.at(name)) peers.push_back(role_of(member) + "." + name);
      text += fmt::format("{}'{}': {{peers: [{}]}}", text.empty() ? "" : ", ", name, fmt::join(peers, ", "));
    }
    return "{" + text + "}";
  }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<std::string>> members_;
};

/// Where the image has a file that is shipped; nullopt: it is none.
std::optional<fs::path> in_image(const fs::path& file) {
  const fs::path config = fs::weakly_canonical(default_config_dir());
  const fs::path below = fs::weakly_canonical(file).lexically_relative(config);
  if (below.empty() || *below.begin() == "..") return std::nullopt;
  return kConfigInImage / below;
}

/// A path of this host as containers see it: what is not in the image is mounted where it is.
fs::path in_container(const fs::path& file) { return in_image(file).value_or(fs::absolute(file).lexically_normal()); }

/// The file FILE of NAME:FILE, which holds a planner's parameters; empty: there is none.
fs::path parameter_file(const UavPlanner& planner) {
  const std::size_t colon = planner.spec.find(':');
  if (exec_command(planner.spec) || colon == std::string::npos || planner.spec.find('=') != std::string::npos) {
    return {};
  }
  return planner.spec.substr(colon + 1);
}

/// Files of this host that a program reads, by their paths in its container.
std::map<fs::path, fs::path> files_of(const FleetPlan& plan, const std::string& program) {
  std::vector<fs::path> files = plan.scenario.vehicle_files;
  files.push_back(plan.scenario.file);
  files.push_back(plan.faults.file);
  files.push_back(plan.faults.named);
  if (program == programs::kSimServer) {  // the only one that knows the scene
    const SceneConfig& scene = plan.scenario.scene;
    files.insert(files.end(), scene.meshes.begin(), scene.meshes.end());
    files.push_back(scene.points);
    files.push_back(scene.boxes);
  }
  std::map<fs::path, fs::path> mounted;
  for (const fs::path& file : files) {
    if (!file.empty() && !in_image(file)) mounted[in_container(file)] = fs::weakly_canonical(file);
  }
  if (programs::is_agent(program)) {
    const fs::path parameters = parameter_file(planner_of(plan, program));
    if (!parameters.empty()) mounted[kParametersInContainer] = fs::weakly_canonical(parameters);
  }
  return mounted;
}

class ComposeText {
 public:
  ComposeText(const FleetPlan& plan, const ComposeLayout& layout) : plan_(plan), layout_(layout), networks_(plan) {}

  std::string text() {
    text_ = fmt::format("# The fleet of '{}', a container a program (docs/containers.md), made by\n#   {}\n",
                        plan_.scenario.name, layout_.command);
    std::string common = kCommon;
    common.replace(common.find("{user}"), 6, layout_.user);
    text_ += common + "\nservices:\n";
    for (const char* server : programs::kServers) add_service(server);
    for (const UavConfig& uav : plan_.scenario.fleet) add_service(programs::agent_program(uav.name));
    if (plan_.ground) add_service(programs::kGroundAgent);
    add_networks();
    if (!layout_.results) add_volumes();
    return text_;
  }

 private:
  void line(int indent, const std::string& text) {
    text_ += std::string(static_cast<std::size_t>(indent), ' ') + text + "\n";
  }

  void add_service(const std::string& program) {
    const bool agent = programs::is_agent(program);
    const auto own_image = layout_.images.find(programs::member_name(program));
    const bool foreign = agent && own_image != layout_.images.end();
    line(2, program + ":");
    line(4, "<<: *program");
    line(4, "image: " + in_quotes(foreign ? own_image->second : agent ? layout_.agent_image : layout_.image));
    // Who is dropped, or crashes, comes back; a run without its server cannot.
    line(4, std::string("restart: ") + (program == programs::kSimServer ? "\"no\"" : "on-failure:5"));
    line(4, std::string("mem_limit: ") + (program == programs::kSimServer ? "4g" : "1g"));
    if (agent) line(4, "cpus: 1");
    line(4, "command:");
    if (!agent) line(6, "- " + program);
    for (const std::string& argument : arguments_of(program)) line(6, "- " + argument);
    line(4, "environment:");
    line(6, "SKEIN_NETWORK: " + in_quotes(networks_.text_for(program)));
    if (foreign) add_variables(program);
    line(4, "networks:");
    for (const std::string& network : networks_.of(program)) {
      line(6, in_quotes(network) + ":");  // YAML takes some words for truth values
      line(8, "aliases:");
      line(10, "- " + role_of(program) + "." + network);
    }
    line(4, "volumes:");
    for (const std::string& volume : volumes_of(program)) line(6, "- " + volume);
    text_ += "\n";
  }

  bool is_debugged(const std::string& program) const {
    return std::ranges::find(plan_.debug, program, &Debuggee::program) != plan_.debug.end();
  }

  /// Quoted; `run` may be a variable.
  std::vector<std::string> arguments_of(const std::string& program) const {
    std::vector<std::string> texts;
    std::vector<std::string> arguments = program_arguments(plan_, program, kComposeBaseDomain);
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
                     {"--keep", "--health", "/tmp/alive", "--lease",
                      std::to_string(plan_.debug.empty() ? kLease_s : kDebuggedLease_s), "--server-timeout",
                      std::to_string(kServerTimeout_s), "--out", kResultsInContainer});
    if (is_debugged(program)) arguments.push_back("--wait-for-debugger");
    if (plan_.options.secure) arguments.insert(arguments.end(), {"--security", kKeysInContainer});
    if (layout_.status_lines) arguments.insert(arguments.end(), {"--status-fd", "1"});
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const bool has_value = i + 1 < arguments.size() && !arguments[i + 1].starts_with("--");
      texts.push_back(literal(arguments[i] + (has_value ? "=" + arguments[i + 1] : "")));
      i += has_value ? 1 : 0;
    }
    texts.push_back(in_quotes("--run=" + layout_.run));
    return texts;
  }

  /// For a client that is no agent of ours, such as a ROS 2 node.
  void add_variables(const std::string& program) {
    const std::string domain = std::to_string(agent_domain(plan_, program, kComposeBaseDomain));
    for (const auto& [name, value] : {std::pair<std::string, std::string>{"SKEIN_DOMAIN", domain},
                                      {"ROS_DOMAIN_ID", domain},
                                      {"SKEIN_UAV", programs::member_name(program)},
                                      {"SKEIN_DDS", dds_vendors(plan_).at(program)},
                                      {"SKEIN_OUT", kResultsInContainer}}) {
      line(6, name + ": " + literal(value));
    }
    line(6, "SKEIN_RUN: " + in_quotes(layout_.run));
  }

  std::vector<std::string> volumes_of(const std::string& program) const {
    std::vector<std::string> volumes = {layout_.results
                                            ? mount(results_of(program, *layout_.results), kResultsInContainer, false)
                                            : in_quotes(volume_of(program) + ":" + kResultsInContainer)};
    for (const auto& [there, here] : files_of(plan_, program)) volumes.push_back(mount(here, there));
    if (plan_.options.secure)
      volumes.push_back(in_quotes(layout_.keys + "/" + program + ":" + kKeysInContainer + ":ro"));
    if (layout_.build && !layout_.images.contains(programs::member_name(program))) {
      volumes.push_back(mount(*layout_.build / "bin", fs::path(kBuildInContainer) / "bin"));
      volumes.push_back(mount(default_config_dir(), fs::path(kBuildInContainer) / "config"));
    }
    return volumes;
  }
  static std::string volume_of(const std::string& program) {
    return programs::is_agent(program) ? "results-" + programs::member_name(program) : "results";
  }

  void add_networks() {
    text_ += "networks:\n";
    std::uint32_t next = layout_.subnet ? layout_.subnet->address : 0;
    for (const std::string& name : networks_.names()) {
      line(2, in_quotes(name) + ":");
      line(4, "internal: true");
      if (!layout_.subnet) continue;
      line(4, "ipam:");
      line(6, "config:");
      const in_addr address{htonl(next)};
      char text[INET_ADDRSTRLEN];
      ::inet_ntop(AF_INET, &address, text, sizeof text);
      line(8, "- subnet: " + std::string(text) + "/" + std::to_string(kNetworkPrefix));
      next += std::uint32_t{1} << (32 - kNetworkPrefix);
    }
  }

  void add_volumes() {
    text_ += "\nvolumes:\n";
    std::vector<std::string> names;
    for (const auto& [program, vendor] : dds_vendors(plan_)) names.push_back(volume_of(program));
    std::ranges::sort(names);
    names.erase(std::ranges::unique(names).begin(), names.end());
    for (const std::string& name : names) line(2, name + ": {}");
  }

  const FleetPlan& plan_;
  const ComposeLayout& layout_;
  const Networks networks_;
  std::string text_;
};

/// A domain is named for each network, and what runs there for each alias; DNS knows no case.
void check_names(const Scenario& scenario) {
  const auto small = [](std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name;
  };
  std::map<std::string, std::string> seen = {{"world", "world"}, {"gcs", "gcs"}};
  for (const UavConfig& uav : scenario.fleet) {
    const auto [other, is_new] = seen.emplace(small(uav.name), uav.name);
    if (is_new) continue;
    throw InputError(scenario.file.string() + ": fleet: in containers '" + uav.name + "' cannot be told from '" +
                     other->second + "', whose network has that name, whatever its case; choose another name");
  }
}

void check(const FleetPlan& plan, const ComposeLayout& layout) {
  check_names(plan.scenario);
  std::vector<UavPlanner> all = plan.planners;
  if (plan.ground) all.push_back(*plan.ground);
  for (const UavPlanner& planner : all) {
    if (layout.images.contains(planner.uav)) continue;
    if (exec_command(planner.spec) || planner.agent || plan.agent) {
      throw InputError("--planner " + planner.uav + "=" + written(planner) +
                       ": a program of this host is in no container; --image " + planner.uav +
                       "=IMAGE names an image that has it");
    }
  }
  std::vector<std::string> known;
  for (const UavPlanner& planner : all) known.push_back(planner.uav);
  for (const auto& [member, image] : layout.images) {
    if (std::ranges::find(known, member) != known.end()) continue;
    throw InputError("--image " + member + "=" + image + ": there is no '" + member + "' in this fleet; " +
                     suggestion(member, known));
  }
  if (!layout.subnet) return;
  const auto wanted = static_cast<std::uint64_t>(domain_count(plan)) << (32 - kNetworkPrefix);
  if ((std::uint64_t{1} << (32 - layout.subnet->prefix)) < wanted) {
    throw InputError(fmt::format("--subnet: the fleet needs {} networks of {} addresses; a /{} would do",
                                 domain_count(plan), 1 << (32 - kNetworkPrefix),
                                 32 - static_cast<int>(std::bit_width(wanted - 1))));
  }
}

}  // namespace

Subnet parse_subnet(const std::string& text) {
  const std::size_t slash = text.find('/');
  in_addr address{};
  Subnet subnet;
  const char* const end = text.data() + text.size();
  const bool has_address =
      slash != std::string::npos && ::inet_pton(AF_INET, text.substr(0, slash).c_str(), &address) == 1;
  const bool whole = has_address && std::from_chars(text.data() + slash + 1, end, subnet.prefix).ptr == end;
  if (!whole || subnet.prefix < 8 || subnet.prefix > kNetworkPrefix) {
    throw InputError("--subnet " + text + ": must be an IPv4 network of 8 to " + std::to_string(kNetworkPrefix) +
                     " bits, as 172.30.0.0/20");
  }
  subnet.address = ntohl(address.s_addr) & ~((std::uint32_t{1} << (32 - subnet.prefix)) - 1);
  return subnet;
}

fs::path results_of(const std::string& program, const fs::path& results) {
  return programs::is_agent(program) ? results / kAgentsFolder / programs::member_name(program) : results;
}

std::string compose_file(const FleetPlan& plan, const ComposeLayout& layout) {
  check(plan, layout);
  return ComposeText(plan, layout).text();
}

}  // namespace skein::cli
