#include "sim_server/hand_node.hpp"

#include <algorithm>
#include <utility>

#include "bus/lockstep/names.hpp"
#include "core/planners/hand_file.hpp"
#include "core/topics.hpp"
#include "idl/hand_conversions.hpp"
#include "process/json_text.hpp"
#include "results/run_folder.hpp"

namespace skein::sim {

HandNode::HandNode(const Scenario& scenario, const Simulation& simulation, const std::vector<UavIndex>& uavs,
                   const std::filesystem::path& folder)
    : scenario_(scenario), simulation_(simulation), desk_(scenario, uavs) {
  for (const UavIndex uav : uavs) {
    flown_.push_back(std::make_unique<Flown>(uav, folder / run_folder::hand_file(scenario.fleet[uav].name)));
    flown_.back()->rows << hand_file::head();
    flown_.back()->rows.flush();
  }
}

HandNode::Flown* HandNode::find(UavIndex uav) {
  const auto found = std::ranges::find_if(flown_, [&](const auto& flown) { return flown->uav == uav; });
  return found == flown_.end() ? nullptr : found->get();
}

void HandNode::declare(UavIndex uav, bus::LockstepServer& server, bus::LockstepServer::DomainIndex domain) {
  if (Flown* flown = find(uav)) {
    flown->writer = &server.writer(domain, bus::spec(topics::hand(scenario_.fleet[uav].name)));
  }
}

void HandNode::begin_step() {
  for (const auto& flown : flown_) {
    const auto news = desk_.news(flown->uav, HandDesk::Clock::now());
    if (!news) continue;
    flown->command = *news;
    flown->due = true;
    ++flown->commands;
    flown->rows << hand_file::line_of({simulation_.step(), simulation_.tick(), *news});
    flown->rows.flush();  // so that no line is lost if the server is killed; there are only a few lines per second
  }
}

void HandNode::publish(UavIndex uav) {
  Flown* flown = find(uav);
  if (flown == nullptr || !std::exchange(flown->due, false)) return;
  flown->writer->write(to_hand_command(simulation_.tick(), flown->command));
}

void HandNode::resend(UavIndex uav) {
  Flown* flown = find(uav);
  if (flown != nullptr) flown->due = flown->commands > 0;
}

void HandNode::hear(UavIndex uav, const std::string& name, double value) {
  if (Flown* flown = find(uav); flown != nullptr && name == kHeldSignal) flown->held = value;
}

std::vector<std::string> HandNode::names() const {
  std::vector<std::string> names;
  for (const auto& flown : flown_) names.push_back(scenario_.fleet[flown->uav].name);
  return names;
}

std::string HandNode::state_json() const {
  Json state = Json::object();
  for (const auto& flown : flown_) {
    const Vector3d& v = flown->command.velocity;
    state[scenario_.fleet[flown->uav].name] = {
        {"velocity", {v.x(), v.y(), v.z()}}, {"yaw_rate", flown->command.yaw_rate}, {"held", flown->held}};
  }
  return state.dump();
}

std::optional<std::vector<HandReport>> HandNode::report() const {
  if (!flies()) return std::nullopt;
  std::vector<HandReport> reports;
  for (const auto& flown : flown_) {
    const std::string& name = scenario_.fleet[flown->uav].name;
    reports.push_back({name, run_folder::hand_file(name), flown->commands});
  }
  return reports;
}

std::vector<std::string> HandNode::finish() {
  std::vector<std::string> troubles;
  for (const auto& flown : flown_) {
    flown->rows.flush();
    if (!flown->rows.write_error().empty()) troubles.push_back(flown->rows.write_error());
  }
  return troubles;
}

}  // namespace skein::sim
