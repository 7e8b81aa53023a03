#include "one_process/session_socket.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace skein::one_process {
namespace {

class SessionSocketTest : public testing::Test {
 protected:
  ~SessionSocketTest() override {
    for (const int end : ends_) ::close(end);
  }

  /// Sends a message with this number of descriptors of /dev/null, as the other program does.
  void say(std::string text, std::size_t files) const {
    std::array<int, 16> given{};
    for (std::size_t i = 0; i < files; ++i) given.at(i) = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(given))> control{};
    iovec part{text.data(), text.size()};
    msghdr head{};
    head.msg_iov = &part;
    head.msg_iovlen = 1;
    if (files > 0) {
      head.msg_control = control.data();
      head.msg_controllen = CMSG_SPACE(files * sizeof(int));
      cmsghdr* const note = CMSG_FIRSTHDR(&head);
      note->cmsg_level = SOL_SOCKET;
      note->cmsg_type = SCM_RIGHTS;
      note->cmsg_len = CMSG_LEN(files * sizeof(int));
      std::memcpy(CMSG_DATA(note), given.data(), files * sizeof(int));
    }
    EXPECT_EQ(::sendmsg(ends_[1], &head, 0), static_cast<ssize_t>(text.size()));
    for (std::size_t i = 0; i < files; ++i) ::close(given.at(i));
  }
  static std::ptrdiff_t open_descriptors() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  }

  static std::array<int, 2> pair() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
    return ends;
  }

  std::array<int, 2> ends_ = pair();
  const SessionSocket socket_{ends_[0]};
};

TEST_F(SessionSocketTest, AMessageArrivesWithItsDescriptorsOrIsRefusedWhole) {
  std::mt19937 random(1);
  const std::ptrdiff_t before = open_descriptors();
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t edge = random() % 3 == 0 ? 4095 : 0;
    const std::size_t bytes = 1 + edge + random() % (edge > 0 ? 3 : 6000), files = random() % 9;
    std::string text;
    while (text.size() < bytes) text += static_cast<char>('a' + random() % 26);
    say(text, files);
    if (bytes > 4096 || files > 4) {
      EXPECT_THROW(socket_.receive(), std::length_error) << bytes << " bytes, " << files << " descriptors";
    } else {
      const auto message = socket_.receive();
      ASSERT_TRUE(message);
      EXPECT_EQ(message->text, text);
      EXPECT_EQ(message->files.size(), files);
      for (const int file : message->files) EXPECT_EQ(::close(file), 0);
    }
    ASSERT_EQ(open_descriptors(), before) << bytes << " bytes, " << files << " descriptors";
  }
}

TEST_F(SessionSocketTest, ASocketWhoseOtherEndIsClosedReceivesNoMessage) {
  ::close(std::exchange(ends_[1], ::open("/dev/null", O_RDONLY | O_CLOEXEC)));
  EXPECT_FALSE(socket_.receive());
  socket_.send("nobody hears it");
}

}  // namespace
}  // namespace skein::one_process
