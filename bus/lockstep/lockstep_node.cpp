#include "bus/lockstep/lockstep_node.hpp"

#include <spdlog/spdlog.h>

namespace skein::bus {

NodeEnd run_node(LockstepNode& node, const StopSignal* stop, const std::function<void()>& on_turn) {
  node.start();
  while (!node.end()) {
    if (stop != nullptr && stop->requested()) return NodeEnd::stopped;
    if (on_turn) on_turn();
    const LockstepNode::Rest rest = node.rest();
    node.turn(node.inbox().dispatch(rest.longest, rest.rings));
  }
  return *node.end();
}

int exit_code(NodeEnd end, const std::string& member) {
  switch (end) {
    case NodeEnd::finished:
    case NodeEnd::stopped:
      return kExitDone;
    case NodeEnd::server_gone:
      spdlog::error("{}: sim_server is gone", member);
      return kExitProcessFailed;
    case NodeEnd::resumed:
    case NodeEnd::dropped:
      spdlog::error("{}: sim_server goes on without us", member);
      return kExitProcessFailed;
  }
  return kExitProcessFailed;
}

}  // namespace skein::bus
