#include "doctor/meeting.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/text/suggestion.hpp"
#include "process/program.hpp"

namespace skein::doctor {
namespace {

constexpr double kClocksAgreeS = 1.0;
constexpr const char* kStartThere = "start `skein doctor net` there too, at the same time, with --seconds to spare";

bool contains(const auto& list, const auto& value) { return std::ranges::find(list, value) != list.end(); }

/// The doctor on a listed peer, identified by its address or by its name; nullptr if it was not heard.
const Acquaintance* find(const Meeting& meeting, const PeerFacts& peer) {
  const auto fits = [&](const auto& entry) {
    const Acquaintance& other = entry.second;
    return (peer.address && (other.from == *peer.address || other.last.address == *peer.address)) ||
           other.last.name == peer.name;
  };
  const auto found = std::ranges::find_if(meeting.heard, fits);
  return found == meeting.heard.end() ? nullptr : &found->second;
}

/// Hint why nothing at all was received from a listed peer.
std::string silence_hint(const Meetings& all, const Meeting& meeting, const PeerFacts& peer) {
  if (!peer.address) return "its name has no address: start it, or write its address instead of its name";
  if (!peer.source) return "there is no route to its address: join its network";
  if (!meeting.address.empty() && *peer.source != meeting.address) {
    return fmt::format(
        "wrong interface: packets to it leave by {}, this domain has {}; name the peer's address in that "
        "network, or set `interface:`",
        *peer.source, meeting.address);
  }
  if (const auto domains = all.elsewhere.find(*peer.address); domains != all.elsewhere.end()) {
    const std::vector<std::string> names(domains->second.begin(), domains->second.end());
    return "it takes part in " + joined(names) + " only; check --scenario, --only and --network there";
  }
  const std::string port = fmt::format("UDP port {}", kGreetingPort);
  if (const auto said = meeting.refused.find(*peer.address); said != meeting.refused.end()) {
    return fmt::format("{} there: {}; {}, or a firewall refuses it", port, said->second, kStartThere);
  }
  return fmt::format("nothing arrives: {}; otherwise a firewall drops UDP (here port {}), or its network is down",
                     kStartThere, kGreetingPort);
}

/// Hint why no DDS samples of a peer arrive, although its datagrams do.
std::string no_dds_hint(const Meeting& meeting, const Acquaintance& other) {
  if (other.last.base != meeting.base) {
    return fmt::format("its fleet's first domain is {}, ours {}: give both hosts the same --domain", other.last.base,
                       meeting.base);
  }
  if (!meeting.address.empty() && !other.at.contains(meeting.address)) {
    return fmt::format("wrong interface: it reaches us at {}, this domain has {}",
                       joined({other.at.begin(), other.at.end()}), meeting.address);
  }
  std::string hint = fmt::format("UDP arrives, DDS does not: perhaps a firewall drops UDP ports {}..{}.",
                                 ports_of(meeting.number, 1).first, ports_of(meeting.number, 10).last);
  if (other.last.vendors != meeting.vendors) {
    hint += fmt::format(" Or the vendors differ: it has {}, we have {}; give both hosts the same --dds",
                        joined(other.last.vendors), joined(meeting.vendors));
  }
  return hint;
}

std::string missing_vendors(const Acquaintance& other) {
  std::vector<std::string> missing;
  for (const std::string& vendor : other.last.vendors) {
    if (!other.dds.contains(vendor)) missing.push_back(vendor);
  }
  return joined(missing);
}

bool mixes_vendors(const Meeting& meeting, const Acquaintance& other) {
  return other.last.vendors.size() > 1 || other.last.vendors != meeting.vendors;
}

/// @returns a verdict and its hint.
std::pair<Verdict, std::string> judge_heard(const Meetings& all, const Meeting& meeting, const Acquaintance& other) {
  if (other.dds.empty()) return {Verdict::fail, no_dds_hint(meeting, other)};
  if (!other.small && !other.large) {
    return {Verdict::ok, fmt::format("its UDP port {} is closed to us; a fleet does not need it", kGreetingPort)};
  }
  if (!other.large && meeting.largest > 0) {
    return {Verdict::fail,
            fmt::format("datagrams of {} bytes do not arrive, small ones do: the network between has a smaller "
                        "MTU; set that of both interfaces to it (ip link set dev IFACE mtu N)",
                        meeting.largest)};
  }
  if (const std::string missing = missing_vendors(other); !missing.empty()) {
    return {Verdict::fail, "nothing arrives over " + missing + ", but messages of its other vendor do"};
  }
  if (!contains(other.last.heard_dds, all.id)) {
    const bool by_udp = contains(other.last.heard_udp, all.id);
    return {Verdict::warn, std::string("it has not received our messages") +
                               (by_udp ? " over DDS, only over UDP" : "") +
                               ", as far as we know: see the output of `skein doctor net` there"};
  }
  if (std::abs(other.clock_ahead_s) > kClocksAgreeS && mixes_vendors(meeting, other)) {
    return {Verdict::warn,
            fmt::format(
                "its clock is {:.1f} s {}: two DDS vendors then lose each other's first samples; set both clocks by "
                "NTP",
                std::abs(other.clock_ahead_s), other.clock_ahead_s > 0 ? "ahead" : "behind")};
  }
  return {Verdict::ok, {}};
}

PeerState state_of(const Meetings& all, const Meeting& meeting, const Acquaintance& other) {
  PeerState state{.peer = other.last.name, .address = other.from, .name = other.last.name};
  state.small = other.small;
  state.large = other.large;
  state.dds = {other.dds.begin(), other.dds.end()};
  state.hears_us = contains(other.last.heard_dds, all.id);
  std::tie(state.verdict, state.hint) = judge_heard(all, meeting, other);
  return state;
}

}  // namespace

void Meetings::note_datagram(const Greeting& greeting, const std::string& from, const std::string& at, std::size_t size,
                             double now_s) {
  if (greeting.id == id) return;
  const auto meeting = std::ranges::find(domains, greeting.domain, &Meeting::domain);
  if (meeting == domains.end()) {
    elsewhere[from].insert(greeting.domain);
    return;
  }
  Acquaintance& other = meeting->heard[greeting.id];
  other.last = greeting;
  other.from = from;
  other.at.insert(at);
  (greeting.size > 0 && size >= greeting.size ? other.large : other.small) = true;
  other.clock_ahead_s = greeting.sent_s - now_s;
}

void Meetings::note_sample(Meeting& meeting, const Greeting& greeting) {
  if (greeting.id == id) return;
  Acquaintance& other = meeting.heard[greeting.id];
  other.last = greeting;
  other.dds.insert(greeting.by);
  if (other.from.empty()) other.from = greeting.address;
}

Greeting Meetings::greeting(const Meeting& meeting) const {
  Greeting greeting{.id = id,
                    .name = name,
                    .domain = meeting.domain,
                    .base = meeting.base,
                    .address = meeting.address,
                    .vendors = meeting.vendors};
  for (const auto& [other, acquaintance] : meeting.heard) {
    if (acquaintance.small || acquaintance.large) greeting.heard_udp.push_back(other);
    if (!acquaintance.dds.empty()) greeting.heard_dds.push_back(other);
  }
  return greeting;
}

std::vector<PeerState> judge_meeting(const Meetings& all, const Meeting& meeting) {
  std::vector<PeerState> states;
  std::set<std::uint32_t> named;
  for (const PeerFacts& peer : meeting.peers) {
    if (peer.ourselves()) continue;
    const Acquaintance* other = find(meeting, peer);
    if (other == nullptr) {
      states.push_back({.verdict = Verdict::fail, .peer = peer.name, .address = peer.address.value_or("")});
      states.back().hint = silence_hint(all, meeting, peer);
      continue;
    }
    named.insert(other->last.id);
    states.push_back(state_of(all, meeting, *other));
    states.back().peer = peer.name;
  }
  for (const auto& [id, other] : meeting.heard) {
    if (named.contains(id)) continue;
    states.push_back(state_of(all, meeting, other));
    if (states.back().verdict == Verdict::fail) states.back().verdict = Verdict::warn;  // the network does not list it
  }
  return states;
}

bool all_hear_each_other(const Meetings& all) {
  return exit_code(all) == kExitDone && std::ranges::all_of(all.domains, [&](const Meeting& meeting) {
           return std::ranges::all_of(judge_meeting(all, meeting),
                                      [](const PeerState& state) { return state.hears_us.value_or(false); });
         });
}

int exit_code(const Meetings& all) {
  for (const Meeting& meeting : all.domains) {
    const auto states = judge_meeting(all, meeting);
    const bool fails = std::ranges::any_of(states, [](const PeerState& s) { return s.verdict == Verdict::fail; });
    if (fails || !meeting.trouble.empty()) return kExitCheckFailed;
  }
  return kExitDone;
}

}  // namespace skein::doctor
