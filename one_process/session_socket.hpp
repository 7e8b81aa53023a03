// A socket for messages to and from the program that steps a fleet (session.hpp). Messages may carry descriptors.
// Linux.   Threads: one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skein::one_process {

struct SessionMessage {
  std::string text;
  std::vector<int> files;  ///< descriptors (close-on-exec), which the receiver owns
};

class SessionSocket {
 public:
  explicit SessionSocket(int descriptor) : descriptor_(descriptor) {}

  int descriptor() const { return descriptor_; }
  /// Waits for a message of up to 4 kB and four descriptors. @returns nullopt when the other end is closed.
  /// @throws std::length_error when a message has more; its descriptors are closed.
  std::optional<SessionMessage> receive() const;
  /// Sends a message; does nothing if the other end is closed.
  void send(std::string_view text) const;
  /// Replaces this socket with another one, under the same descriptor number. @param descriptor of the other socket; is
  /// closed.
  void become(int descriptor) const;

 private:
  const int descriptor_;
};

}  // namespace skein::one_process
