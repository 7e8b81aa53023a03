#include "process/status/turn_page.hpp"

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

/// The text up to the first zero byte; all of it if a program has overwritten that byte.
std::string text_of(std::span<const char> text) { return {text.begin(), std::find(text.begin(), text.end(), '\0')}; }

void write(std::span<char> to, const std::string& text) {
  const std::size_t size = std::min(text.size(), to.size() - 1);
  std::copy_n(text.begin(), size, to.begin());
  to[size] = '\0';
}

}  // namespace

struct TurnPage::Content {
  struct Seat {
    std::atomic<std::uint64_t> turns;
    std::array<char, 120> holder;
  };
  std::array<Seat, kSeats> seats;
  std::atomic<pid_t> process;
  std::array<char, 256> reason, reason_of;
};

TurnPage::TurnPage() : fd_(::memfd_create("skein-turns", MFD_CLOEXEC)) {
  if (fd_ < 0 || ::ftruncate(fd_, sizeof(Content)) != 0) fail("page of turns");
  map();
}

TurnPage::TurnPage(const std::filesystem::path& file) : fd_(::open(file.c_str(), O_RDWR | O_CLOEXEC)) {
  if (fd_ < 0) fail(file.string());
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
  if (memory == MAP_FAILED) fail("page of turns");
  content_ = static_cast<Content*>(memory);
}

// Closes the file itself, because constructors call it, and no destructor follows a constructor that throws.
void TurnPage::fail(const std::string& what) {
  const int reason = errno;
  if (fd_ >= 0) ::close(fd_);
  throw std::system_error(reason, std::generic_category(), what);
}

std::filesystem::path TurnPage::path() const {
  return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(fd_);
}

void TurnPage::clear() {
  for (Content::Seat& seat : content_->seats) {
    seat.turns = 0;
    seat.holder[0] = '\0';
  }
  content_->process = 0;
  content_->reason[0] = content_->reason_of[0] = '\0';
}

void TurnPage::enter(std::size_t seat, const std::string& program) {
  write(content_->seats[seat].holder, program);
  ++content_->seats[seat].turns;
}

void TurnPage::leave(std::size_t seat) { ++content_->seats[seat].turns; }

void TurnPage::give_reason(const std::string& reason, const std::string& program) {
  write(content_->reason_of, program);
  write(content_->reason, reason);
}

std::uint64_t TurnPage::turns(std::size_t seat) const { return content_->seats[seat].turns; }

std::string TurnPage::holder(std::size_t seat) const {
  return turns(seat) % 2 == 1 ? text_of(content_->seats[seat].holder) : std::string();
}

std::vector<std::string> TurnPage::holders() const {
  if (std::string program = text_of(content_->reason_of); !program.empty()) return {std::move(program)};
  std::vector<std::string> programs;
  for (std::size_t seat = 0; seat < kSeats; ++seat) {
    if (std::string program = holder(seat); !program.empty()) programs.push_back(std::move(program));
  }
  return programs;
}

std::string TurnPage::reason() const { return text_of(content_->reason); }

pid_t TurnPage::process() const { return content_->process; }

}  // namespace skein
