// The launcher's end of its connection to one host: runs the carrier (ssh, srun), exchanges frames with the host, and
// detects that the host is silent. Threads: one, which must live as long as the connection (program_start.hpp).
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>

#include "cli/place/frames.hpp"
#include "cli/place/placement.hpp"
#include "host/program_start.hpp"

namespace skein::cli {

class HostLink {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts the carrier. @param log  receives the carrier's error messages.
  /// @throws std::system_error when it cannot be started.
  HostLink(const PlacedHost& host, std::filesystem::path log);
  /// Closes the connection: the host ends its programs and exits. Waits at most kSilence, then kills the carrier.
  ~HostLink();
  HostLink(const HostLink&) = delete;
  HostLink& operator=(const HostLink&) = delete;

  const std::string& name() const { return name_; }
  /// Readable when the host has sent something; -1: the host is lost.
  int descriptor() const { return lost() ? -1 : carrier_.status.get(); }
  /// Sends a frame; does nothing if the host is lost. Waits for a slow host only if more than 1 MiB is unsent.
  void send(const Json& head, std::string_view body = {});
  /// The frames that have arrived. Never blocks. Also finds out whether the host is lost, and sends it signs of life.
  std::deque<Frame> take();
  /// Waits for the host's answer, at most 30 s. Drops the frames before it. @param what  "say" of the answer.
  /// @throws InputError if the host reports trouble instead, is lost, or does not answer in time.
  Frame answer(const std::string& what);

  bool lost() const { return !why_.empty(); }
  /// Why the host is lost, as a message: "hostB is gone: ...".
  const std::string& why() const { return why_; }
  /// Declares the host lost. @param why  the reason, for why().
  void lose(const std::string& why);

 private:
  void read();
  void flush(std::chrono::milliseconds patience);
  std::string complaint() const;

  const std::string name_;
  const std::filesystem::path log_;
  StartedProgram carrier_;
  FrameReader reader_{false};
  std::deque<Frame> others_;  ///< frames that came with an answer, after it; for take()
  std::string unsent_, why_;
  bool met_ = false;  ///< the host has sent a frame
  Clock::time_point heard_ = Clock::now(), spoke_ = Clock::now();
};

}  // namespace skein::cli
