#include "one_process/program_output.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "process/program.hpp"

namespace skein::one_process {
namespace {

/// Whose it is now.
const ProgramOutput* current = nullptr;

}  // namespace

ProgramOutput::ProgramOutput(const std::filesystem::path& file, bool append)
    : fd_(file.empty()
              ? -1
              : ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (append ? 0 : O_TRUNC), 0644)) {
  if (fd_ < 0 && !file.empty()) throw std::system_error(errno, std::generic_category(), file.string());
}

ProgramOutput::~ProgramOutput() {
  if (current == this) current = nullptr;
  if (fd_ >= 0) ::close(fd_);
}

void ProgramOutput::enter() {
  if (current == this) return;
  if (fd_ >= 0) {
    std::fflush(stdout);  // of the one before
    ::dup2(fd_, STDOUT_FILENO);
    ::dup2(fd_, STDERR_FILENO);
  }
  if (log_) spdlog::set_default_logger(log_);
  current = this;
}

void ProgramOutput::set_log(const std::string& name, const std::string& level) {
  log_ = make_log(name, level);
  if (current == this) spdlog::set_default_logger(log_);
}

}  // namespace skein::one_process
