// A process whose fleet is stepped by a program outside (skein.Fleet in Python). It stands between steps, and is copied
// there: a reset is a copy of a process that has no fleet yet, a fork is one of a fleet.
// They talk over a socket (SOCK_SEQPACKET), a message each way in turn, JSON but for "s COUNT" and "k":
//
//   {"do": "reset", "seed": N}  a copy begins a fleet. With it come three descriptors: the copy's own socket, a memfd
//                               for its block of memory, and a file for what its programs print. The copy says hello
//                               on its socket.
//   {"do": "fork"}              the same, of the fleet as it stands.
//   s COUNT                     the fleet goes on by so many steps: "k", and "e" when the run has ended.
//   {"do": "result"}, {"do": "scene"}  see SteppedFleet. With them comes a memfd, into which the answer goes.
//
// What went wrong is {"failed": why, "program": name, "code": exit code, "signal": number}; after that the process
// ends. It also ends when the socket's other end is closed.   Linux.   Threads: one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "one_process/session_guard.hpp"
#include "one_process/session_socket.hpp"
#include "one_process/stepped_fleet.hpp"

namespace skein::one_process {

/// What the launcher says of a fleet that is to be stepped (cli/fleet_command.cpp).
struct SessionPlan {
  std::vector<shared_lines::Start> programs;
  std::vector<std::string> uavs;  ///< names in fleet order
  nlohmann::json about;           ///< handed on with each hello
};

/// @throws std::runtime_error when the file is none.
SessionPlan read_session_plan(const std::filesystem::path& file);

class Session {
 public:
  /// @param socket  its descriptor. @param patience_s  see SessionGuard.
  Session(SessionPlan plan, int socket, double patience_s);
  ~Session();
  /// Until the other end is closed. @returns the exit code.
  int serve();

 private:
  void answer(const SessionMessage& message);
  /// In the parent true; in the copy false, and its descriptors are those of the message.
  bool copy(const SessionMessage& message);
  void load_scene();
  void begin(std::uint64_t seed);
  void hello();
  void fail(const FleetFailed& failed);
  void cut_log() const;

  const SessionPlan plan_;
  SessionSocket socket_;
  SessionGuard guard_;
  const std::shared_ptr<sim::SceneShelf> shelf_ = std::make_shared<sim::SceneShelf>();
  std::unique_ptr<SteppedFleet> fleet_;
  std::byte* block_ = nullptr;  ///< of `fleet_`
  int block_fd_ = -1;           ///< between copy() and begin()
  std::uint64_t answers_ = 0;
};

/// main() of such a process. @param argv  --session DESCRIPTOR --plan FILE
int run_session(int argc, const char* const* argv);

}  // namespace skein::one_process
