// A program at the ground station that sends nothing: it logs which UAVs enter and leave the line of sight, and the
// radio messages that it receives. `--planner patrol,gcs=listen`.
#include <spdlog/spdlog.h>

#include <set>

#include "uav_agent/api/ground_program.hpp"

namespace skein::agent {
namespace {

class Listen final : public GroundProgram {
 public:
  struct Config {
    int longest_text = 80;  ///< most characters of a message in the log; chosen

    void describe(auto& r) { r.field("longest_text", longest_text, within(0, 10000)); }
  };

  Listen(const Config& config, const AgentConfig& ground) : config_(config), ground_(ground) {}

  std::vector<RadioMessage> work(const GroundInput& input) override {
    std::set<Node> linked;
    for (const Neighbour& neighbour : input.linked) linked.insert(neighbour.node);
    for (const UavIndex i : FirstUavs(ground_.fleet.size())) {
      const bool was = linked_.contains(node_of_uav(i)), is = linked.contains(node_of_uav(i));
      if (was != is)
        spdlog::info("{:.2f} s: {} {}", seconds(input.tick), ground_.fleet[i].name, is ? "in sight" : "out of sight");
    }
    linked_ = std::move(linked);
    for (const RadioMessage& message : input.radio) {
      spdlog::info("{:.2f} s: {}: {}", seconds(input.tick), message.topic,
                   message.text.substr(0, static_cast<std::size_t>(config_.longest_text)));
    }
    return {};
  }

 private:
  const Config config_;
  const AgentConfig ground_;
  std::set<Node> linked_;
};

SKEIN_REGISTER_GROUND_PROGRAM("listen", Listen);

}  // namespace
}  // namespace skein::agent
