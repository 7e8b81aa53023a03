#include "one_process/program_output.hpp"

#include <fcntl.h>
#include <spdlog/sinks/sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <streambuf>
#include <system_error>

#include "process/health/crash_notes.hpp"
#include "process/program.hpp"

namespace skein::one_process {
namespace {

/// The program whose log descriptors 1 and 2 lead to; null: none.
const ProgramOutput* current = nullptr;
/// The program whose log this thread's output goes to; null: none.
thread_local const ProgramOutput* mine = nullptr;

/// Descriptors and log of the process, from before there were programs; and the log that chooses by thread.
int own_stdout = -1, own_stderr = -1;
std::shared_ptr<spdlog::logger> own_log, led_log;

int descriptor_here(int own) { return mine != nullptr && mine->descriptor() >= 0 ? mine->descriptor() : own; }

ssize_t write_all(int fd, const char* text, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t written = ::write(fd, text + done, size - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return -1;
    done += static_cast<std::size_t>(written);
  }
  return static_cast<ssize_t>(size);
}

/// Unbuffered, so that the output of different threads does not mix in a buffer.
class LedBuffer final : public std::streambuf {
 public:
  explicit LedBuffer(const int& own) : own_(own) {}

 protected:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char character = traits_type::to_char_type(c);
    return write_all(descriptor_here(own_), &character, 1) < 0 ? traits_type::eof() : c;
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    return write_all(descriptor_here(own_), text, static_cast<std::size_t>(size));
  }

 private:
  const int& own_;
};

ssize_t write_led(void* own, const char* text, std::size_t size) {
  return write_all(descriptor_here(*static_cast<const int*>(own)), text, size);
}

/// A C stream that writes to the log of the calling thread's program.
FILE* led_file(int& own) {
  FILE* file = ::fopencookie(&own, "w", {.read = nullptr, .write = write_led, .seek = nullptr, .close = nullptr});
  if (file == nullptr) throw std::system_error(errno, std::generic_category(), "fopencookie");
  std::setvbuf(file, nullptr, _IONBF, 0);
  return file;
}

/// Passes each line to the log of the calling thread's program.
class LedLog final : public spdlog::logger {
 public:
  LedLog() : spdlog::logger("led") {
    set_level(spdlog::level::trace);
    flush_on(spdlog::level::trace);
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::logger* const log = mine != nullptr && mine->log() != nullptr ? mine->log() : own_log.get();
    if (log == nullptr || !log->should_log(message.level)) return;
    spdlog::details::log_msg named = message;
    named.logger_name = log->name();
    for (const auto& sink : log->sinks()) {
      sink->log(named);
      sink->flush();
    }
  }
  void flush_() override {}
};

}  // namespace

ProgramOutput::ProgramOutput(const std::filesystem::path& file, bool append)
    : fd_(file.empty()
              ? -1
              : ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (append ? 0 : O_TRUNC), 0644)) {
  if (fd_ < 0 && !file.empty()) throw std::system_error(errno, std::generic_category(), file.string());
}

ProgramOutput::~ProgramOutput() {
  if (current == this) current = nullptr;
  if (mine == this) mine = nullptr;
  if (fd_ >= 0) ::close(fd_);
}

void ProgramOutput::enter() {
  if (current == this) return;
  if (fd_ >= 0) {
    std::fflush(stdout);  // into the log of the previous program
    ::dup2(fd_, STDOUT_FILENO);
    ::dup2(fd_, STDERR_FILENO);
  }
  if (log_) spdlog::set_default_logger(log_);
  current = mine = this;
}

void ProgramOutput::enter_beside() const {
  mine = this;
  if (fd_ >= 0) note_crashes_in(fd_);
}

void ProgramOutput::leave_beside() {
  mine = nullptr;
  note_crashes_in(STDERR_FILENO);
}

const ProgramOutput* ProgramOutput::here() { return mine; }

void ProgramOutput::lead_by_thread(std::ostream& out) {
  std::fflush(stdout);
  own_stdout = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  own_stderr = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  stdout = led_file(own_stdout);
  stderr = led_file(own_stderr);
  static auto& led_out = *new LedBuffer(own_stdout);  // never destroyed: used until the process ends
  static auto& led_err = *new LedBuffer(own_stderr);
  out.rdbuf(&led_out);
  std::cerr.rdbuf(&led_err);
  std::clog.rdbuf(&led_err);
  own_log = spdlog::default_logger();
  led_log = std::make_shared<LedLog>();
}

void ProgramOutput::stand_aside() {
  mine = nullptr;
  if (current == nullptr) return;
  current = nullptr;
  ::dup2(own_stdout, STDOUT_FILENO);
  ::dup2(own_stderr, STDERR_FILENO);
  spdlog::set_default_logger(led_log);
}

void ProgramOutput::set_log(const std::string& name, const std::string& level) {
  log_ = make_log(name, level);
  if (current == this) spdlog::set_default_logger(log_);
}

}  // namespace skein::one_process
