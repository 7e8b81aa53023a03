// What the router has counted, kept in a file from step to step, so that a router which is killed and started again
// counts on, and what it had at hand when it died is counted as lost. Not thread-safe.
#pragma once

#include <filesystem>
#include <span>

#include "comm_router/link_gate.hpp"
#include "core/run_id.hpp"

namespace skein::router {

class CountStore {
 public:
  /// Opens or creates the file; what another run counted is none of ours, and begins at 0. It is mapped: what is
  /// written survives the death of this process (not of the machine).
  /// @throws std::system_error when the file cannot be opened, made as long as it must be, or mapped.
  CountStore(const std::filesystem::path& file, std::size_t nodes, RunId run = RunId::none);
  ~CountStore();
  CountStore(const CountStore&) = delete;
  CountStore& operator=(const CountStore&) = delete;

  /// What an earlier life of this router counted. What it had not yet delivered, or delivered with its last breath, is
  /// dropped_fault.
  LinkMatrix<LinkCounts> earlier_counts() const;

  /// After each step. @param last  what left the router with it: it counts as delivered from the next step on, since a
  /// router that dies before takes it along.
  void save(const LinkGate& gate, const GatedStep& last);

 private:
  struct Head;

  Head* head_ = nullptr;  ///< the file, in memory
  std::size_t nodes_;
  std::span<LinkCounts> counts_;  ///< of each link, as a LinkMatrix has them
  LinkMatrix<LinkCounts> saved_;  ///< as the file has it; kept for its memory
};

}  // namespace skein::router
