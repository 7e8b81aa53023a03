// The router's part of a run's recording: each radio message as it was sent, and where it arrives.
#pragma once

#include "comm_router/link_gate.hpp"
#include "comm_router/router_sync.hpp"
#include "core/scenario/scenario.hpp"
#include "recording/recorder.hpp"

namespace skein::router {

/// Topic of the recording that tells which messages reach which node.
inline constexpr const char* kArrivalsTopic = "/skein/arrivals";

class RecordingNode {
 public:
  /// Both must outlive this.
  RecordingNode(const Scenario& scenario, recording::Recorder& recorder) : scenario_(scenario), recorder_(recorder) {}

  /// Records a step's messages. Call it before the router delivers. @param gated  what it delivers with this step.
  void add(const StepBatch& batch, const std::vector<RadioRoute>& routes, const GatedStep& gated);
  void flush() { recorder_.flush(); }

 private:
  const Scenario& scenario_;
  recording::Recorder& recorder_;
};

}  // namespace skein::router
