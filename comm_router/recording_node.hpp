// The router's part of a run's recording: each radio message as it was sent, and where it arrives.
#pragma once

#include "comm_router/link_gate.hpp"
#include "comm_router/router_sync.hpp"
#include "core/scenario.hpp"
#include "recording/recorder.hpp"

namespace skein::router {

/// In the recording: which messages reach whom.
inline constexpr const char* kArrivalsTopic = "/skein/arrivals";

class RecordingNode {
 public:
  /// Both must outlive this.
  RecordingNode(const Scenario& scenario, recording::Recorder& recorder) : scenario_(scenario), recorder_(recorder) {}

  /// A step's messages, before they are handed on. @param gated  what arrives with it.
  void add(const StepBatch& batch, const std::vector<RadioRoute>& routes, const GatedStep& gated);
  void flush() { recorder_.flush(); }

 private:
  const Scenario& scenario_;
  recording::Recorder& recorder_;
};

}  // namespace skein::router
