#include "cli/compose/stack_parts.hpp"

#include <spdlog/fmt/fmt.h>

namespace skein::cli {
namespace {

constexpr const char* kUid = "${SKEIN_UID:-1000}";
constexpr const char* kGid = "${SKEIN_GID:-1000}";

}  // namespace

std::string stack_user() { return std::string(kUid) + ":" + kGid; }

void add_deployment(ComposeYaml& yaml, const Deployment& deployment) {
  yaml.key("deploy").begin_map();
  // A service's name resolves to its container's own address: DDS does not work behind a virtual address.
  yaml.key("endpoint_mode").own("dnsrr");
  if (!deployment.node.empty() || deployment.manager) {
    yaml.key("placement").begin_map().key("constraints").begin_list();
    if (deployment.node.empty()) {
      yaml.own("node.role == manager");
    } else {
      yaml.literal("node.hostname == " + deployment.node);
    }
    yaml.end_list().end_map();
  }
  yaml.key("resources").begin_map().key("limits").begin_map();
  yaml.key("memory").own(deployment.memory);
  if (!deployment.cpus.empty()) yaml.key("cpus").own(deployment.cpus);
  yaml.key("pids").number(kMostProcesses);
  yaml.end_map().end_map();
  yaml.key("restart_policy").begin_map().key("condition").own(deployment.restarts > 0 ? "on-failure" : "none");
  if (deployment.restarts > 0) yaml.key("max_attempts").number(deployment.restarts);
  yaml.end_map().end_map();
}

void SentFiles::add(ComposeYaml& yaml, const std::string& kind, Names& names, const Files& files, int mode) {
  if (files.empty()) return;
  yaml.key(kind).begin_list();
  for (const auto& [there, here] : files) {
    const std::string name = names.try_emplace(here, fmt::format("{}-{}", kind, names.size())).first->second;
    yaml.begin_map().key("source").own(name).key("target").literal(there.string());
    yaml.key("uid").own(kUid).key("gid").own(kGid);
    yaml.key("mode").number(mode).end_map();
  }
  yaml.end_list();
}

void SentFiles::add_sources(ComposeYaml& yaml) const {
  for (const auto& [kind, names] : {std::pair("configs", &configs_), {"secrets", &secrets_}}) {
    if (names->empty()) continue;
    yaml.key(kind).begin_map();
    for (const auto& [file, name] : *names) {
      yaml.key(name).begin_map().key("file").literal(file.string()).end_map();
    }
    yaml.end_map();
  }
}

}  // namespace skein::cli
