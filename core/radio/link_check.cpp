#include "core/radio/link_check.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/text/suggestion.hpp"

namespace skein {
namespace {

bool is_group(const std::string& name) { return name == "all" || name == "uavs"; }

}  // namespace

void check_link_effect(const LinkEffect& effect, const std::vector<std::string>& nodes, const std::string& key,
                       ConfigErrors& errors) {
  errors.check(effect.acts_on_messages() || effect.range_m, key,
               "changes nothing: give at least one of loss, burst_loss, latency_s, jitter_s, bandwidth_bit_s, range_m, "
               "duplication, reordering, corruption, above 0");
  const bool is_loop = effect.from == effect.to && effect.from.size() == 1 && !is_group(effect.from[0]);
  errors.check(!is_loop, key + ".to",
               "no node sends to itself: name another node than '" + (is_loop ? effect.from[0] : std::string()) +
                   "', or leave one of them out");
  for (const auto& [end, names] : {std::pair("from", &effect.from), std::pair("to", &effect.to)}) {
    const std::string path = key + "." + end;
    errors.check(!names->empty(), path, "must name at least one node, or be the word all or uavs");
    std::set<std::string> seen;
    for (const std::string& name : *names) {
      const bool known = is_group(name) || std::ranges::find(nodes, name) != nodes.end();
      if (!known) errors.check(false, path, "there is no node '" + name + "'; " + suggestion(name, nodes));
      errors.check(seen.insert(name).second, path, "'" + name + "' is named twice");
    }
  }
}

}  // namespace skein
