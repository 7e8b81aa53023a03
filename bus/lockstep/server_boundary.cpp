// LockstepServer: lets programs join at a boundary between two steps; lists the programs for which it waits, there and
// within a step.
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "bus/lockstep/names.hpp"
#include "bus/lockstep/server.hpp"
#include "core/text/suggestion.hpp"

namespace skein::bus {

// ---- joining ----------------------------------------------------------------------------------------------------

void LockstepServer::on_ready(DomainIndex domain, std::size_t door, const msg::Ready& ready, ParticipantId source) {
  Place* place = find(ready.member());
  if (place == nullptr || place->domain != domain || place->door != door || gone_.contains(source)) return;
  if (place->source != 0 && place->source != source) {
    place->next.emplace(source, ready);  // its predecessor is not yet known to be dead
    return;
  }
  take_ready(*place, source, ready);
}

void LockstepServer::take_ready(Place& place, ParticipantId source, const msg::Ready& ready) {
  if (place.member) return;
  place.source = source;
  if (ready.revision() == 0) {
    if (on_hello_) on_hello_(place.domain, ready.writes());
    return;
  }
  place.declared = true;
  place.reads = ready.reads();
  place.writes = ready.writes();
}

void LockstepServer::invite(Place& place) {
  const Domain& domain = *domains_.at(place.domain);
  auto resync = message_of<msg::Resync>(inbox_.run());
  resync.member(place.name);
  resync.source(place.source);
  resync.k(k_);
  resync.epoch(epoch_);
  resync.base(all_counts(domain));
  if (place.name == kRouterName) {
    // The new router does not need what the members have sent so far: it counts from there.
    for (const Place& other : places_) {
      for (const auto& sent : other.sent) resync.base().push_back(topic_count(sent.topic, sent.source, sent.count));
    }
  }
  domains_.at(place.domain)->resync->begin_step();
  domains_.at(place.domain)->resync->write(resync);
  place.invited = true;
}

bool LockstepServer::endpoints_matched(const Place& place) const {
  const Domain& domain = *domains_.at(place.domain);
  if (!domain.step->matches(place.source)) return false;
  if (place.name != kRouterName && !contains(door_of(place).done->matched(), place.source)) return false;
  const auto listed = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const auto& writer : domain.writers) {
    if (listed(place.reads, writer->topic()) && !writer->matches(place.source)) return false;
  }
  for (const auto& [topic, reader] : domain.readers) {
    if (listed(place.writes, topic) && !contains(reader->matched(), place.source)) return false;
  }
  return place.name != kRouterName || drop_->matches(place.source);
}

bool LockstepServer::attached_by_router(const Place& place) const {
  const Place* r = router();
  return place.name == kRouterName || r == nullptr || attached_.contains({r->source, place.source});
}

bool LockstepServer::router_attached_all() const {
  return std::all_of(places_.begin(), places_.end(),
                     [&](const Place& p) { return !p.member || attached_by_router(p); });
}

bool LockstepServer::at_boundary() {
  // The router first: programs that join at the same boundary must then be attached by it.
  std::vector<Place*> order;
  for (Place& place : places_) {
    order.insert(place.name == kRouterName ? order.begin() : order.end(), &place);
  }
  bool closed = true;
  for (Place* place : order) {
    if (place->member) continue;
    // The death of a program that was not a member yet may never be reported, although its hello has arrived.
    if (place->source != 0 && !contains(door_of(*place).ready->matched(), place->source)) vacate(*place);
    if (place->source == 0 && place->next) {
      const auto [source, ready] = *place->next;
      place->next.reset();
      take_ready(*place, source, ready);
    }
    if (place->order) continue;
    if (place->source == 0) {
      closed = closed && !place->awaited;
      continue;
    }
    if (!place->invited) invite(*place);
    if (!place->declared || !endpoints_matched(*place) || !attached_by_router(*place)) {
      closed = false;
      continue;
    }
    place->member = true;
    domains_[place->domain]->newcomer = true;
    place->awaited = false;
    membership_changed_ = true;
    if (place->was_member || place->was_lost) rejoined_.push_back(place->name);
    place->was_member = true;
  }
  return closed && router_attached_all();
}

// ---- waiting ----------------------------------------------------------------------------------------------------

std::vector<LockstepServer::Awaited> LockstepServer::awaited() const {
  return in_step_ ? awaited_in_step() : awaited_at_boundary();
}

/// What the router currently waits for from this participant, according to its report; empty: nothing reported.
std::string LockstepServer::awaited_by_router(const Place& place) const {
  const auto& members = awaits_.members();
  const auto told = std::find_if(members.begin(), members.end(), [&](const msg::Await& await) {
    return await.source() == place.source && await.joining() != in_step_ && (!in_step_ || awaits_.k() == k_);
  });
  return told == members.end() ? "" : told->what();
}

std::vector<LockstepServer::Awaited> LockstepServer::awaited_in_step() const {
  std::vector<Awaited> result;
  for (const Place& place : places_) {
    if (!place.member || place.name == kRouterName) continue;
    // A member whose announced commands have not arrived has not answered, either.
    const std::vector<std::string> missing = domains_[place.domain]->commands.missing(place.source);
    if (!place.answered) {
      result.push_back({place.name, fmt::format("done of step {}", k_)});
    } else if (!missing.empty()) {
      result.push_back({place.name, fmt::format("{}", fmt::join(missing, ", "))});
    } else if (const std::string what = awaited_by_router(place); !what.empty()) {
      result.push_back({place.name, what});
    }
  }
  // The router cannot answer before all others have: the server waits for it only if it waits for no other member.
  if (const Place* r = router(); r != nullptr && !r->answered && result.empty()) {
    result.push_back({r->name, fmt::format("deliveries of step {}", k_)});
  }
  return result;
}

std::vector<LockstepServer::Awaited> LockstepServer::awaited_at_boundary() const {
  std::vector<Awaited> result;
  const Place* r = router();
  std::vector<std::string> unattached;  // members that the router has not attached, without a reported reason
  for (const Place& place : places_) {
    const bool at_the_door = !place.member && !place.order && (place.awaited || place.source != 0);
    if (!place.member && !at_the_door) continue;
    if (at_the_door && place.source == 0) {
      result.push_back({place.name, "nothing heard of it yet"});
    } else if (at_the_door && !place.declared) {
      result.push_back({place.name, "its topics have not yet matched those of sim_server"});
    } else if (at_the_door && !endpoints_matched(place)) {
      result.push_back({place.name, "topics of sim_server have not yet matched its own"});
    } else if (!attached_by_router(place)) {
      const std::string what = awaited_by_router(place);
      const bool gone = !contains(door_of(place).ready->matched(), place.source);
      if (!what.empty() || gone)
        result.push_back({place.name, gone ? "its participant has gone" : what});
      else
        unattached.push_back(place.name);
    }
  }
  if (r != nullptr && result.empty() && !unattached.empty()) {
    result.push_back({r->name, "to attach the radio of " + joined_first(unattached)});
  }
  return result;
}

}  // namespace skein::bus
