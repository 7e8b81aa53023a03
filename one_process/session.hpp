// A process whose fleet an external program steps (skein.Fleet in Python). Between steps the fleet stands still, and
// the process can be copied by fork(): a reset copies a process that has no fleet yet, a fork copies one with a fleet.
// The two talk over a socket (SOCK_SEQPACKET): to each message there is one reply, before the next message. Messages
// are JSON except for "s COUNT", "k" (done) and "e":
//
//   {"do": "reset", "seed": N}  a copy of the process starts a fleet. Three descriptors come with the message: the
//                               copy's own socket, a memfd for its memory block, and a file for the output of its
//                               programs. The copy sends its hello on its own socket.
//   {"do": "fork"}              the same, but the copy continues the fleet in its present state.
//   s COUNT                     the fleet flies COUNT steps. Reply: "k", or "e" when the run has ended.
//   {"do": "result"}, {"do": "scene"}  see SteppedFleet. A memfd comes with the message; the answer is written into it.
//
// After an error the process sends {"failed": why, "program": name, "code": exit code, "signal": number} and ends. It
// also ends when the other end of the socket is closed.   Linux.   Threads: one.
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

/// The launcher's description of a fleet that is to be stepped (cli/fleet_command.cpp).
struct SessionPlan {
  std::vector<shared_lines::Start> programs;
  std::vector<std::string> uavs;  ///< names in fleet order
  nlohmann::json about;           ///< sent unchanged with the hello of a process without fleet
};

/// @throws std::exception when the file is missing or is not a plan.
SessionPlan read_session_plan(const std::filesystem::path& file);

class Session {
 public:
  /// @param socket  descriptor of the socket. @param patience_s  see SessionGuard.
  Session(SessionPlan plan, int socket, double patience_s);
  ~Session();
  /// Answers messages until the other end of the socket is closed, or an error occurs. @returns the exit code.
  int serve();

 private:
  void answer(const SessionMessage& message);
  /// Copies the process. @returns true in the parent; false in the copy, which now uses the descriptors of the message.
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
  std::byte* block_ = nullptr;  ///< memory block of `fleet_`
  int block_fd_ = -1;           ///< its memfd, between copy() and begin()
  std::uint64_t answers_ = 0;
};

/// The main() of a process with a session. @param argv  --session DESCRIPTOR --plan FILE
int run_session(int argc, const char* const* argv);

}  // namespace skein::one_process
