#include "comm_router/router_node.hpp"

#include <algorithm>
#include <utility>

#include "bus/lockstep/names.hpp"
#include "comm_router/link_stages.hpp"
#include "core/topics.hpp"
#include "idl/type_names.hpp"

namespace skein::router {

using bus::LockstepClient;

namespace {

bool listed(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bus::TopicSpec radio_spec(const std::string& topic, const std::string& type, std::size_t sources = 1) {
  return {topic, type, bus::Qos{.reliable = true, .latched = false, .depth = topics::radio_depth(sources)}};
}

std::vector<SentCount> sent_counts(const msg::Done& done) {
  std::vector<SentCount> counts;
  for (const auto& sent : done.sent()) counts.push_back({sent.topic(), sent.count()});
  return counts;
}

}  // namespace

RouterNode::RouterNode(const Scenario& scenario, std::uint64_t seed, int base_domain, bus::Bus& bus,
                       const FaultPlan& faults)
    : scenario_(scenario),
      gate_(radio_routes(scenario), scenario.fleet.size() + 1,
            std::make_unique<LinkStages>(scenario, faults, seed)),
      sync_(gate_.routes()),
      world_(bus.join(world_domain(base_domain))),
      client_(*world_, inbox_, std::string(bus::kRouterName)) {
  for (Node node = 0; node < gate_.nodes(); ++node) nodes_.push_back(bus.join(node_domain(base_domain, node)));
  for (Node node = 0; node < gate_.nodes(); ++node) {
    done_readers_.push_back(
        bus::subscribe<msg::Done>(inbox_, *nodes_[node], bus::spec(topics::done()),
                                  [this](const msg::Done& done, bus::ParticipantId source) {
                                    sync_.on_done(source, done.k(), sent_counts(done));
                                  }));
    ready_readers_.push_back(bus::subscribe<msg::Ready>(
        inbox_, *nodes_[node], bus::spec(topics::ready()),
        [this, node](const msg::Ready& ready, bus::ParticipantId source) { on_ready(node, ready, source); }));
  }
  drop_reader_ = bus::subscribe<msg::Drop>(inbox_, *world_, bus::spec(topics::drop()),
                                           [this](const msg::Drop& drop) { sync_.on_drop(drop.k(), drop.source()); });
  client_.declare_writer(bus::spec(topics::attached()), LockstepClient::Counterpart::server);
  client_.declare_writer(bus::spec(topics::routed()), LockstepClient::Counterpart::server);
  client_.declare_when([this] {
    open_radio();
    return true;
  });
}

// Only after the server's invitation: it stands still until we are a member, so no message is under way, and the
// members' counts that it told us are exact.
void RouterNode::open_radio() {
  if (std::exchange(radio_open_, true)) return;
  const auto& routes = gate_.routes();
  for (std::size_t r = 0; r < routes.size(); ++r) {
    const RadioRoute& route = routes[r];
    const auto queue = [this, r](bus::Sample&& sample) {
      sync_.on_radio(sample.source, r, std::make_shared<const std::vector<std::uint8_t>>(std::move(sample.payload)));
    };
    // Of no use before the Done that counts them; once all of those are here, rings() waits for any sample.
    radio_readers_.push_back(inbox_.subscribe(*nodes_[route.source], radio_spec(route.topic, route.type), queue,
                                              bus::Bell::silent));
    auto& arrivals = arrival_of_.emplace_back();
    for (const RadioTarget& target : route.targets) arrivals.push_back(find_or_open_arrival(target, route.type));
  }
  for (const auto& base : client_.base()) sync_.set_base(base.source, base.topic, base.count);
}

std::size_t RouterNode::find_or_open_arrival(const RadioTarget& target, const std::string& type) {
  const auto found = std::find_if(arrivals_.begin(), arrivals_.end(),
                                  [&](const Arrival& a) { return a.node == target.node && a.topic == target.topic; });
  if (found == arrivals_.end()) {
    arrivals_.push_back(
        {target.node, target.topic,
         std::make_unique<bus::CountedWriter>(*nodes_[target.node], radio_spec(target.topic, type, gate_.nodes()))});
    return arrivals_.size() - 1;
  }
  return static_cast<std::size_t>(found - arrivals_.begin());
}

void RouterNode::on_ready(Node node, const msg::Ready& ready, bus::ParticipantId source) {
  if (ready.revision() == 0) return;
  applicants_[source] = {ready.member(), node, ready.revision(), ready.reads(), ready.writes(), false};
}

bool RouterNode::endpoints_match(const Applicant& applicant, bus::ParticipantId source) const {
  if (!bus::contains(done_readers_[applicant.node]->matched(), source)) return false;
  const auto& routes = gate_.routes();
  for (std::size_t r = 0; r < routes.size(); ++r) {
    if (routes[r].source == applicant.node && listed(applicant.writes, routes[r].topic) &&
        !bus::contains(radio_readers_[r]->matched(), source)) {
      return false;
    }
  }
  return std::all_of(arrivals_.begin(), arrivals_.end(), [&](const Arrival& arrival) {
    return arrival.node != applicant.node || !listed(applicant.reads, arrival.topic) || arrival.writer->matches(source);
  });
}

bool RouterNode::attach() {
  if (!radio_open_ || client_.server() == 0) return true;
  bool waiting = false;
  std::erase_if(applicants_, [&](const auto& entry) {
    const auto& [source, applicant] = entry;
    return !applicant.attached && !bus::contains(ready_readers_[applicant.node]->matched(), source);  // it left
  });
  for (auto& [source, applicant] : applicants_) {
    if (applicant.attached) continue;
    if (!endpoints_match(applicant, source)) {
      waiting = true;
      continue;
    }
    msg::Attached attached;
    attached.member(applicant.member);
    attached.source(source);
    attached.revision(applicant.revision);
    attached.router(nodes_[applicant.node]->id());
    client_.write(topics::attached().name, attached);
    applicant.attached = true;
  }
  return waiting;
}

void RouterNode::begin_step() {
  const msg::Step& step = client_.step();
  std::vector<RadioMember> members;
  for (const auto& member : step.members()) {
    if (member.name() == bus::kRouterName) continue;
    const auto applicant = applicants_.find(member.source());
    if (applicant != applicants_.end()) members.push_back({member.name(), member.source(), applicant->second.node});
  }
  sync_.on_step(step.k(), step.epoch(), std::move(members), step.links());
  if (step.final_step()) last_k_ = step.k();
}

void RouterNode::deliver(const StepBatch& batch) {
  const GatedStep gated = gate_.gate(batch.k, batch.links, batch.messages);
  std::map<Node, std::map<std::size_t, std::uint64_t>> delivered;  // by node, arrival: count
  for (const Delivery& delivery : gated.deliveries) {
    const std::size_t index = arrival_of_[delivery.route][delivery.target];
    Arrival& arrival = arrivals_[index];
    const auto [entry, first] = delivered[arrival.node].try_emplace(index, 0);
    if (first) arrival.writer->begin_step();
    arrival.writer->write(*delivery.payload);
    entry->second = arrival.writer->count();
  }

  msg::Routed routed;
  routed.k(batch.k);
  routed.epoch(batch.epoch);
  for (const auto& [node, counts] : delivered) {
    msg::NodeCounts entry;
    entry.node(scenario_.node_name(node));
    for (const auto& [index, total] : counts) {
      msg::TopicCount count;
      count.topic(arrivals_[index].topic);
      count.source(nodes_[node]->id());
      count.count(total);
      entry.delivered().push_back(count);
    }
    routed.nodes().push_back(std::move(entry));
  }
  routed.digest(gated.digest);
  client_.write(topics::routed().name, routed);
  last_step_answered_ = batch.k == last_k_;
}

bool RouterNode::serve() {
  const bool waiting = attach();
  while (const auto batch = sync_.take()) deliver(*batch);
  return waiting;
}

std::size_t RouterNode::rings() const { return sync_.waiting() ? sync_.missing_answers() : client_.rings(); }

void RouterNode::poll() {
  if (!attaching_ && !client_.waits_for_matches() && !inbox_.ready(rings())) return;
  inbox_.dispatch(std::chrono::milliseconds(0));
  if (client_.poll() == LockstepClient::Event::think) begin_step();
  attaching_ = serve();
}

int RouterNode::run(const StopSignal& stop) {
  const bus::ClientLoop loop{.think = [this] { begin_step(); },
                             .serve = [this] { return serve(); },
                             .rings = [this] { return rings(); },
                             .answered_last = [this] { return last_step_answered_; }};
  return bus::exit_code(bus::run_client(client_, inbox_, loop, stop), "comm_router");
}

}  // namespace skein::router
