// What the router has counted, kept in a file from step to step, so that a router which is killed and started again
// counts on, and what it had at hand when it died is counted as lost. Not thread-safe.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "comm_router/link_gate.hpp"
#include "core/run/run_id.hpp"

namespace skein::router {

class CountStore {
 public:
  /// Opens or creates the file; what another run counted is none of ours, and begins at 0. What is written survives the
  /// death of this process (not of the machine). In kNowhere (process/files/nowhere.hpp) nothing is kept.
  /// @throws std::system_error when the file cannot be opened, or made as long as it must be.
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
  /// Why nothing is saved any more; empty: it is.
  const std::string& trouble() const { return trouble_; }

 private:
  struct Head;

  bool write(std::size_t at, const void* data, std::size_t bytes);
  std::system_error failure() const;

  const std::filesystem::path file_;
  LinkMatrix<LinkCounts> counts_;  ///< as the file has them
  std::string trouble_;
  int fd_;
};

}  // namespace skein::router
