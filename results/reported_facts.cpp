#include "results/reported_facts.hpp"

#include "results/run_folder.hpp"

namespace skein::results {
namespace {

/// Programs that a fault kept out at the end: it killed or paused them, and did not end.
std::set<std::string> out_by_fault(const SimServerReport& sim) {
  std::set<std::string> out;
  for (const FaultReport& fault : sim.faults) {
    const bool of_process = fault.kind == "kill" || fault.kind == "pause";
    if (of_process && fault.began_step && !fault.ended_step && fault.target)
      out.insert(programs::program_of(*fault.target));
  }
  return out;
}

}  // namespace

RunFacts reported_facts(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports) {
  RunFacts facts;
  facts.out_by_fault = out_by_fault(*reports.sim_server);
  const auto set_vendor = [&](const std::string& program, const auto& vendor) {
    if (vendor) facts.dds[program] = *vendor;
  };
  set_vendor(programs::kSimServer, reports.sim_server->flight.dds);
  if (reports.station) {
    set_vendor(programs::kStation, reports.station->dds);
    // The ledger is not available here. What was delivered has been earned; how much more was earned is unknown.
    facts.score_earned = reports.station->score.value_or(0.0);
  }
  if (reports.comm_router) set_vendor(programs::kCommRouter, reports.comm_router->dds);
  for (const UavConfig& uav : scenario.fleet) {
    const AgentReport agent = reports.agents.at(uav.name).value_or(AgentReport{});
    facts.planners.push_back({uav.name, agent.planner.value_or("unknown")});
    set_vendor(programs::agent_program(uav.name), agent.dds);
  }
  const Json ground = read_json(dir / run_folder::report_file(programs::kGroundAgent));
  if (ground.is_object()) {
    const auto report = struct_of<AgentReport>(ground);
    facts.ground_program = UavPlanner{"gcs", report.planner.value_or("unknown")};
    set_vendor(programs::kGroundAgent, report.dds);
  }
  return facts;
}

}  // namespace skein::results
