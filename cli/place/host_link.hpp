// The launcher's end of its connection to one host: the program that carries it (ssh, srun), frames there and back, and
// whether the other end still speaks. One thread, which must live as long as the connection (program_start.hpp).
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>

#include "cli/host/program_start.hpp"
#include "cli/place/frames.hpp"
#include "cli/place/placement.hpp"

namespace skein::cli {

class HostLink {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts the connection. @param log  takes what the program that carries it complains of.
  /// @throws std::system_error when that cannot be started.
  HostLink(const PlacedHost& host, std::filesystem::path log);
  /// Closes it: the host ends what it has and goes.
  ~HostLink();
  HostLink(const HostLink&) = delete;
  HostLink& operator=(const HostLink&) = delete;

  const std::string& name() const { return name_; }
  /// Readable when the host has said something; -1 when it is lost.
  int descriptor() const { return lost() ? -1 : carrier_.status.get(); }
  /// Nothing happens when the host is lost.
  void send(const Json& head, std::string_view body = {});
  /// What has arrived. Never blocks; finds out whether the host is lost, and tells it that we are here.
  std::deque<Frame> take();
  /// Waits for the frame that answers what was asked; a frame of trouble is thrown.
  /// @throws InputError with the host's trouble, or when it is lost before.
  Frame answer(const std::string& what);

  bool lost() const { return !why_.empty(); }
  /// Why the host is lost, for people: "hostB is gone: ...".
  const std::string& why() const { return why_; }
  void lose(const std::string& why);

 private:
  void read();
  void flush(std::chrono::milliseconds patience);
  std::string complaint() const;

  const std::string name_;
  const std::filesystem::path log_;
  StartedProgram carrier_;
  FrameReader reader_{false};
  std::string unsent_, why_;
  bool met_ = false;  ///< it has said something
  Clock::time_point heard_ = Clock::now(), spoke_ = Clock::now();
};

}  // namespace skein::cli
