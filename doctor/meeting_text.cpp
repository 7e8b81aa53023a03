// The results of `skein doctor net` as text and as JSON.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <ostream>

#include "core/text/suggestion.hpp"
#include "doctor/meeting.hpp"
#include "process/program.hpp"

namespace skein::doctor {
namespace {

const char* yes_or_no(bool yes) { return yes ? "yes" : "no"; }

std::string full_name(const PeerState& state) {
  std::string text = state.peer.empty() ? "?" : state.peer;
  std::string more = state.address == state.peer ? "" : state.address;
  if (!state.name.empty() && state.name != state.peer) more += (more.empty() ? "" : ", ") + state.name;
  return more.empty() ? text : text + " (" + more + ")";
}

std::string heading(const Meetings& all, const Meeting& meeting) {
  const std::string from = meeting.address.empty() ? "the vendor's interfaces" : meeting.address;
  std::string by = joined(meeting.vendors, " and ");
  return fmt::format("domain {} ({}): {} from {}, by {}", meeting.number, meeting.domain, all.name, from,
                     by.empty() ? "no DDS" : by);
}

void print_states(std::ostream& out, const Meeting& meeting, const std::vector<PeerState>& states) {
  std::size_t width = 4;
  for (const PeerState& state : states) width = std::max(width, full_name(state).size());
  const std::string large = std::to_string(meeting.largest) + " bytes";
  const auto line = [&](const char* verdict, const std::string& peer, const auto& udp, const auto& full,
                        const std::string& dds, const auto& hears) {
    out << fmt::format("  {:<4}  {:<{}}  {:<3}  {:<{}}  {:<19}  {}\n", verdict, peer, width, udp, full, large.size(),
                       dds, hears);
  };
  line("", "peer", "UDP", large, "DDS", "hears us");
  for (const PeerState& state : states) {
    line(word_of(state.verdict), full_name(state), yes_or_no(state.small), yes_or_no(state.large),
         state.dds.empty() ? "no" : joined(state.dds, ", "), state.hears_us ? yes_or_no(*state.hears_us) : "?");
    if (!state.hint.empty()) out << "        -> " << state.hint << '\n';
  }
}

}  // namespace

void print(std::ostream& out, const Meetings& all) {
  for (const Meeting& meeting : all.domains) {
    out << heading(all, meeting) << '\n';
    if (!meeting.trouble.empty()) out << "  FAIL  " << meeting.trouble << '\n';
    const std::vector<PeerState> states = judge_meeting(all, meeting);
    if (states.empty()) {
      out << "        it heard no other host, and no other peer is named\n";
    } else {
      print_states(out, meeting, states);
    }
  }
}

Json as_json(const Meetings& all) {
  Json domains = Json::array();
  for (const Meeting& meeting : all.domains) {
    Json peers = Json::array();
    for (const PeerState& state : judge_meeting(all, meeting)) {
      peers.push_back({{"verdict", word_of(state.verdict)},
                       {"peer", state.peer},
                       {"address", state.address},
                       {"name", state.name},
                       {"udp", state.small},
                       {"udp_large", state.large},
                       {"dds", state.dds},
                       {"hint", state.hint}});
      if (state.hears_us) peers.back()["hears_us"] = *state.hears_us;
    }
    domains.push_back({{"domain", meeting.domain},
                       {"number", meeting.number},
                       {"address", meeting.address},
                       {"largest", meeting.largest},
                       {"vendors", meeting.vendors},
                       {"trouble", meeting.trouble},
                       {"peers", peers}});
  }
  return {{"ok", exit_code(all) == kExitDone}, {"name", all.name}, {"domains", domains}};
}

}  // namespace skein::doctor
