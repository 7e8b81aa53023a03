// Keeps the router's message counts in a file, written after each step. A router that is killed and restarted continues
// to count from there, and the messages that it held when it died count as lost. Not thread-safe.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "comm_router/link_gate.hpp"
#include "core/run/run_id.hpp"

namespace skein::router {

class CountStore {
 public:
  /// Opens or creates the file; if it has the counts of another run, all counts begin at 0. The written counts survive
  /// the death of this process (not of the machine). In kNowhere (process/files/nowhere.hpp) nothing is kept.
  /// @throws std::system_error when the file cannot be opened or written in full length.
  CountStore(const std::filesystem::path& file, std::size_t nodes, RunId run = RunId::none);
  ~CountStore();
  CountStore(const CountStore&) = delete;
  CountStore& operator=(const CountStore&) = delete;

  /// The counts from before the restart. Messages that the router had not delivered by then, or delivered in its last
  /// step, count as dropped_fault.
  LinkMatrix<LinkCounts> earlier_counts() const;

  /// Call it after each step. @param last  the messages that the router delivers with this step. The file counts them
  /// as delivered only from the next step on, because they are lost if the router dies before.
  void save(const LinkGate& gate, const GatedStep& last);
  /// The reason why counts are no longer saved; empty while they are saved.
  const std::string& write_error() const { return write_error_; }

 private:
  struct Head;

  bool write(std::size_t at, const void* data, std::size_t bytes);
  std::system_error failure() const;

  const std::filesystem::path file_;
  LinkMatrix<LinkCounts> counts_;  ///< as the file has them
  std::string write_error_;
  int fd_;
};

}  // namespace skein::router
