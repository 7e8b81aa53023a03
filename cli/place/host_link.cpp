#include "cli/place/host_link.hpp"

#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <optional>
#include <utility>

#include "core/text/text.hpp"
#include "core/types.hpp"
#include "process/host/environment.hpp"

namespace skein::cli {
namespace {

using std::chrono::milliseconds;

/// Longest wait for an answer. The first one includes the login and the start of `skein --host`.
constexpr double kMeet_s = 30.0;
constexpr std::size_t kMostUnsent = 1 << 20, kLogLines = 5;
constexpr milliseconds kLook{200};

/// The carrier's stdin and stdout are the pipes that start_program() makes; its stderr goes to the log.
ProgramSpec carrier_of(const PlacedHost& host, const std::filesystem::path& log) {
  return {host.name,
          {"/bin/sh", "-c", fmt::format("exec {} <&{} >&{}", shell_line(host.connect), kControlFd, kStatusFd)},
          environment_with({}),
          log};
}

}  // namespace

HostLink::HostLink(const PlacedHost& host, std::filesystem::path log)
    : name_(host.name), log_(std::move(log)), carrier_(start_program(carrier_of(host, log_))) {}

HostLink::~HostLink() {
  if (!lost()) flush(kSpeak);
  carrier_.control.reset();  // the host reads end-of-file
  pollfd ended{carrier_.pidfd.get(), POLLIN, 0};
  if (lost() || ::poll(&ended, 1, static_cast<int>(kSilence.count())) <= 0) ::kill(-carrier_.program, SIGKILL);
  ::waitpid(carrier_.pid, nullptr, 0);
}

void HostLink::send(const Json& head, std::string_view body) {
  if (lost()) return;
  unsent_ += bytes_of(head, body);
  spoke_ = Clock::now();
  flush(unsent_.size() > kMostUnsent ? kSilence : milliseconds(0));
}

void HostLink::flush(milliseconds patience) {
  std::size_t sent = 0;
  while (sent < unsent_.size()) {
    const ssize_t n = ::write(carrier_.control.get(), unsent_.data() + sent, unsent_.size() - sent);
    if (n > 0) sent += static_cast<std::size_t>(n);
    if (n > 0 || errno == EINTR) continue;
    pollfd writable{carrier_.control.get(), POLLOUT, 0};
    if (errno != EAGAIN || ::poll(&writable, 1, static_cast<int>(patience.count())) <= 0) break;
  }
  unsent_.erase(0, sent);
}

void HostLink::read() {
  std::array<char, 65536> buffer;
  for (int i = 0; i < 64; ++i) {  // limited, so that other hosts have their turn
    const ssize_t n = ::read(carrier_.status.get(), buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) return lose("the connection has ended");
    if (n < 0) return;
    heard_ = Clock::now();
    reader_.add({buffer.data(), static_cast<std::size_t>(n)});
  }
}

std::deque<Frame> HostLink::take() {
  std::deque<Frame> frames = std::exchange(others_, {});
  if (lost()) return frames;
  read();
  try {
    while (auto frame = reader_.next()) {
      met_ = true;
      if (frame->text("say") != "alive") frames.push_back(std::move(*frame));
    }
  } catch (const std::exception& error) {
    lose(std::string("it sends ") + error.what());
  }
  const auto now = Clock::now();
  if (met_ && now - heard_ > kSilence)
    lose(fmt::format("it has said nothing for {} s", kSilence / std::chrono::seconds(1)));
  if (now - spoke_ > kSpeak) send({{"do", "alive"}});
  if (!unsent_.empty()) flush(milliseconds(0));
  return frames;
}

Frame HostLink::answer(const std::string& what) {
  const auto deadline = Clock::now() + std::chrono::duration<double>(kMeet_s);
  std::optional<Frame> answer;
  while (true) {
    for (Frame& frame : take()) {
      if (answer) {
        others_.push_back(std::move(frame));
      } else if (frame.text("say") == "trouble") {
        throw InputError("--place: " + name_ + ": " + frame.text("text"));
      } else if (frame.text("say") == what) {
        answer = std::move(frame);
      }
    }
    if (answer) return std::move(*answer);
    if (!lost() && Clock::now() > deadline) lose(fmt::format("it has not answered for {:.0f} s", kMeet_s));
    if (lost()) throw InputError("--place: " + why_);
    pollfd readable{carrier_.status.get(), POLLIN, 0};
    ::poll(&readable, 1, static_cast<int>(kLook.count()));
  }
}

void HostLink::lose(const std::string& why) {
  if (lost()) return;
  why_ = (met_ ? name_ + " is gone: " : name_ + " cannot be used: ") + why + complaint();
}

/// The carrier's messages, and what the host's shell printed instead of the greeting.
std::string HostLink::complaint() const {
  std::string text = last_lines_below(log_, kLogLines);
  if (!met_ && !reader_.before_greeting().empty()) text += "\n  " + reader_.before_greeting();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace skein::cli
