#include "cli/compose/compose_networks.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "core/topics.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

std::string role_of(const std::string& program) {
  if (program == programs::kSimServer) return "sim";
  if (program == programs::kCommRouter) return "router";
  if (program == programs::kStation) return "station";
  return program == programs::kGroundAgent ? "program" : "uav";
}

}  // namespace

ComposeNetworks::ComposeNetworks(const FleetPlan& plan) : names_(domain_names(plan.scenario)) {
  for (const auto& [program, vendor] : dds_vendors(plan)) {
    const bool everywhere = program == programs::kSimServer || program == programs::kCommRouter;
    for (const std::string& name : names_) {
      const bool stations = program == programs::kStation && (name == names_[0] || name == names_[1]);
      if (everywhere || stations || programs::member_name(program) == name) members_[name].push_back(program);
    }
  }
}

std::vector<std::string> ComposeNetworks::of(const std::string& program) const {
  std::vector<std::string> networks;
  std::ranges::copy_if(names_, std::back_inserter(networks), [&](const std::string& name) {
    return std::ranges::find(members_.at(name), program) != members_.at(name).end();
  });
  return networks;
}

std::string ComposeNetworks::text_for(const std::string& program) const {
  std::string text;
  for (const std::string& name : of(program)) {
    std::vector<std::string> peers;
    for (const std::string& member : members_.at(name)) peers.push_back(alias(member, name));
    text += fmt::format("{}'{}': {{peers: [{}]}}", text.empty() ? "" : ", ", name, fmt::join(peers, ", "));
  }
  return "{" + text + "}";
}

std::string ComposeNetworks::alias(const std::string& program, const std::string& network) {
  return role_of(program) + "." + network;
}

}  // namespace skein::cli
