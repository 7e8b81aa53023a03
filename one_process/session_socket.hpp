// A socket that carries messages with open files, to and from the program that steps a fleet (session.hpp).
// Linux.   Threads: one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skein::one_process {

struct SessionMessage {
  std::string text;
  std::vector<int> files;  ///< descriptors, closed on exec; whoever takes the message owns them
};

class SessionSocket {
 public:
  explicit SessionSocket(int descriptor) : descriptor_(descriptor) {}

  int descriptor() const { return descriptor_; }
  /// Waits. @returns nullopt when the other end is closed.
  std::optional<SessionMessage> receive() const;
  /// To an end that is closed nothing is sent.
  void send(std::string_view text) const;
  /// Another socket takes the place of this one, under the same descriptor. @param descriptor  is closed
  void become(int descriptor) const;

 private:
  const int descriptor_;
};

}  // namespace skein::one_process
