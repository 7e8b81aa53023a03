// A strategy's program at the ground station as a DDS node (`uav_agent --role gcs`): reads topics, executes one step of
// the program, sends its radio messages. It joins only the ground station's DDS domain. Everything happens on the
// thread that calls run().
#pragma once

#include <memory>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "uav_agent/api/ground_program.hpp"
#include "uav_agent/member_node.hpp"
#include "uav_agent/radio_node.hpp"

namespace skein::agent {

class GroundNode final : public MemberNode {
 public:
  GroundNode(const Scenario& scenario, std::unique_ptr<GroundProgram> program, int base_domain, bus::Bus& bus);

 private:
  void declare(bus::LockstepClient& client) override;
  void work(const bus::LockstepClient::Step& step) override;
  void send(bus::LockstepClient& client) override;

  const RadioNode radio_;
  const std::unique_ptr<GroundProgram> program_;
  GroundInput input_;  ///< inputs of the next step, filled as samples arrive
  std::vector<RadioMessage> output_;
};

}  // namespace skein::agent
