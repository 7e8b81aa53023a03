#include "cli/compose/compose_checks.hpp"

#include <arpa/inet.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// Networks and aliases are named after UAVs, and DNS ignores case: so names must differ in more than case, also from
/// the fixed networks' names.
void check_names(const Scenario& scenario, bool watched) {
  const auto small = [](std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name;
  };
  std::map<std::string, std::string> seen = {{"world", "world"}, {"gcs", "gcs"}};
  if (watched) seen.emplace(kViewNetwork, kViewNetwork);
  for (const UavConfig& uav : scenario.fleet) {
    const auto [other, is_new] = seen.emplace(small(uav.name), uav.name);
    if (is_new) continue;
    throw InputError(scenario.file.string() + ": fleet: in containers '" + uav.name + "' and '" + other->second +
                     "' would have the same network name, which ignores case; choose another name");
  }
}

/// @param option  the option or variable that names the image
void check_image(const std::string& option, const std::string& image) {
  const std::string_view marks = "._-/:@";
  const auto may_be = [&](unsigned char c) { return std::isalnum(c) != 0 || marks.find(char(c)) != marks.npos; };
  if (!image.empty() && std::isalnum(static_cast<unsigned char>(image[0])) && std::ranges::all_of(image, may_be))
    return;
  throw InputError(option + ": '" + printable(image) +
                   "' is not the name of an image, such as my-planner or registry.example:5000/team/planner:1.2");
}

}  // namespace

void check_layout(const FleetPlan& plan, const ComposeLayout& layout) {
  check_names(plan.scenario, layout.view.has_value());
  for (const auto& [variable, image] : layout.chosen) check_image(variable, image);
  std::vector<UavPlanner> all = plan.planners;
  if (plan.ground) all.push_back(*plan.ground);
  for (const UavPlanner& planner : all) {
    if (layout.images.contains(planner.uav)) continue;
    if (exec_command(planner.spec) || planner.agent || plan.agent) {
      throw InputError(
          "--planner " + planner.uav + "=" + written(planner) +
          ": a container does not have this host's programs; name an image that has this one with --image " +
          planner.uav + "=IMAGE");
    }
  }
  std::vector<std::string> known;
  for (const UavPlanner& planner : all) known.push_back(planner.uav);
  for (const auto& [member, image] : layout.images) {
    if (std::ranges::find(known, member) != known.end()) {
      check_image("--image " + member, image);
      continue;
    }
    throw InputError("--image " + member + "=" + image + ": there is no '" + member + "' in this fleet; " +
                     suggestion(member, known));
  }
  if (!layout.subnet) return;
  const int networks = domain_count(plan) + (layout.view ? 1 : 0);
  const auto wanted = static_cast<std::uint64_t>(networks) << (32 - kNetworkPrefix);
  if ((std::uint64_t{1} << (32 - layout.subnet->prefix)) < wanted) {
    throw InputError(fmt::format("--subnet: the fleet needs {} networks of {} addresses; a /{} would do", networks,
                                 1 << (32 - kNetworkPrefix), 32 - static_cast<int>(std::bit_width(wanted - 1))));
  }
}

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

}  // namespace skein::cli
