// Writes capture_messages.csv: what links that are not ideal did to messages with capture reports. One line for each
// message that was lost or late although the UAV was linked to the station: the step in which it was sent, the UAV, the
// step in which it arrives (empty: lost). A restarted router appends to the file. Not thread-safe; no bus.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "comm_router/link_gate.hpp"
#include "core/scenario/scenario.hpp"
#include "process/files/stream_file.hpp"

namespace skein::router {

/// Lets another model decide, and records its decisions about messages with capture reports.
class LinkRecord final : public LinkModel {
 public:
  /// @param scenario   must outlive this.
  /// @param unwritten  gets a sentence when the disk refuses; the router goes on. Must outlive this.
  LinkRecord(std::unique_ptr<LinkModel> links, const Scenario& scenario, const std::filesystem::path& folder,
             std::vector<std::string>& unwritten);

  LinkFate fate(std::uint64_t k, const RadioRoute& route, Node target, const SentMessage& message) override;
  void begin_step(const Links& links) override { links_->begin_step(links); }
  void set_off(std::size_t fault, Tick tick) override { links_->set_off(fault, tick); }
  void set_by_hand(const std::vector<Fault>& faults) override { links_->set_by_hand(faults); }

 private:
  void write(const std::string& line);

  std::unique_ptr<LinkModel> links_;
  const Scenario& scenario_;
  std::filesystem::path file_;
  std::vector<std::string>& unwritten_;
  std::optional<StreamFile> out_;  ///< opened with the first line: most runs have none
  bool refused_ = false;           ///< the disk has refused a write: nothing more is written
};

}  // namespace skein::router
