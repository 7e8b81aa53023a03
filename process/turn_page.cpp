#include "process/turn_page.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <span>
#include <system_error>
#include <utility>

namespace skein {
namespace {

/// Ends with a zero byte whatever a program wrote there.
std::string text_of(std::span<const char> text) { return {text.begin(), std::find(text.begin(), text.end(), '\0')}; }

void write(std::span<char> to, const std::string& text) {
  const std::size_t size = std::min(text.size(), to.size() - 1);
  std::copy_n(text.begin(), size, to.begin());
  to[size] = '\0';
}

}  // namespace

struct TurnPage::Content {
  std::atomic<std::uint64_t> turns;
  std::atomic<pid_t> process;
  std::array<char, 256> holder, reason;
};

TurnPage::TurnPage() : fd_(::memfd_create("skein-turns", MFD_CLOEXEC)) {
  if (fd_ < 0 || ::ftruncate(fd_, sizeof(Content)) != 0) {
    throw std::system_error(errno, std::generic_category(), "page of turns");
  }
  map();
}

TurnPage::TurnPage(const std::filesystem::path& file) : fd_(::open(file.c_str(), O_RDWR | O_CLOEXEC)) {
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), file.string());
  map();
  content_->process = ::getpid();
  ::close(std::exchange(fd_, -1));
}

TurnPage::~TurnPage() {
  ::munmap(content_, sizeof(Content));
  if (fd_ >= 0) ::close(fd_);
}

void TurnPage::map() {
  void* const memory = ::mmap(nullptr, sizeof(Content), PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0);
  if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "page of turns");
  content_ = static_cast<Content*>(memory);
}

std::filesystem::path TurnPage::path() const {
  return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(fd_);
}

void TurnPage::clear() {
  content_->turns = 0;
  content_->process = 0;
  content_->holder[0] = content_->reason[0] = '\0';
}

void TurnPage::enter(const std::string& program) {
  write(content_->holder, program);
  ++content_->turns;
}

void TurnPage::leave() { ++content_->turns; }

void TurnPage::give_reason(const std::string& reason) { write(content_->reason, reason); }

std::uint64_t TurnPage::turns() const { return content_->turns; }

std::string TurnPage::holder() const { return turns() % 2 == 1 ? text_of(content_->holder) : std::string(); }

std::string TurnPage::reason() const { return text_of(content_->reason); }

pid_t TurnPage::process() const { return content_->process; }

}  // namespace skein
