#include "process/status/status_pipe.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "process/status/shared_lines.hpp"

namespace skein {

StatusPipe::StatusPipe(int fd) : pipe_(std::make_shared<Pipe>(fd)) {
  if (fd < 0) return;
  std::signal(SIGPIPE, SIG_IGN);
  const int flags = ::fcntl(fd, F_GETFL);
  if (flags < 0 || ::fcntl(fd, F_SETFL, flags | O_NONBLOCK) != 0) {
    throw std::runtime_error("status pipe: file descriptor " + std::to_string(fd) + " is not open");
  }
}

StatusPipe::StatusPipe(const StatusPipe& shared, std::string program)
    : pipe_(shared.pipe_), program_(std::move(program)) {}

std::string StatusPipe::line_of(const nlohmann::json& message) const {
  // Replaces invalid UTF-8: a stray byte must not end a run.
  return (program_.empty() ? message : shared_lines::said_by(program_, message))
             .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
         '\n';
}

void StatusPipe::send(const nlohmann::json& message) {
  if (!is_open()) return;
  const std::lock_guard lock(pipe_->mutex);
  if (!pipe_->flush()) return;
  std::string& unsent = pipe_->unsent = line_of(message);
  const std::size_t size = unsent.size();
  if (!pipe_->flush() && unsent.size() == size) unsent.clear();  // nothing was written: drop the whole line
}

void StatusPipe::send_surely(const nlohmann::json& message) {
  if (!is_open()) return;
  const std::lock_guard lock(pipe_->mutex);
  pipe_->unsent += line_of(message);
  while (!pipe_->flush()) {
    pollfd waiting{pipe_->fd, POLLOUT, 0};
    ::poll(&waiting, 1, -1);
  }
}

bool StatusPipe::Pipe::flush() {
  while (!unsent.empty()) {
    const ssize_t written = ::write(fd, unsent.data(), unsent.size());
    if (written > 0) {
      unsent.erase(0, static_cast<std::size_t>(written));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return false;
    } else if (errno != EINTR) {
      unsent.clear();  // the reader is gone
    }
  }
  return true;
}

ControlPipe::ControlPipe(int fd, std::function<void(const std::string&)> on_line, std::function<void()> on_end)
    : fd_(fd), on_line_(std::move(on_line)), on_end_(std::move(on_end)) {
  if (fd_ < 0) return;
  stop_fd_ = ::eventfd(0, EFD_CLOEXEC);
  if (stop_fd_ < 0) throw std::runtime_error("control pipe: no event descriptor");
  thread_ = std::thread([this] { run(); });
}

ControlPipe::~ControlPipe() {
  if (!thread_.joinable()) return;
  const std::uint64_t one = 1;
  static_cast<void>(!::write(stop_fd_, &one, sizeof one));  // an eventfd always takes a 1
  thread_.join();
  ::close(stop_fd_);
}

void ControlPipe::run() {
  constexpr std::size_t kLongestLine = 1 << 20;
  std::string pending;
  std::array<char, 4096> chunk{};
  while (true) {
    std::array<pollfd, 2> waiting{{{stop_fd_, POLLIN, 0}, {fd_, POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno == EINTR) continue;
    if (waiting[0].revents != 0) return;
    const ssize_t size = ::read(fd_, chunk.data(), chunk.size());
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (size <= 0 || pending.size() > kLongestLine) break;
    pending.append(chunk.data(), static_cast<std::size_t>(size));
    for (std::size_t end = pending.find('\n'); end != std::string::npos; end = pending.find('\n')) {
      const std::string line = pending.substr(0, end);
      pending.erase(0, end + 1);
      on_line_(line);
    }
  }
  if (on_end_) on_end_();
}

}  // namespace skein
