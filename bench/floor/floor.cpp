#include "bench/floor/floor.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <ctime>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

namespace skein::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kMatchPoll{2}, kRoundLimit{60'000};
/// Rounds before the measurement. A writer may match a reader before the reader matches the writer. The reader then
/// misses the writer's first samples, and receives them only after the writer's next heartbeat.
constexpr std::uint64_t kWarmUp = 10;

double process_cpu_s() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// This process as a part of the benchmark: its DDS endpoints, and what it writes and awaits in each round.
class Participant {
 public:
  Participant(const Seat& seat, const std::vector<Flow>& flows) : vendor_(make_vendor()) {
    for (const Flow& flow : flows) {
      if (flow.writer == seat) {
        writers_.push_back(vendor_->open_writer(flow));
        expected_matches_.push_back(flow.readers.size());
      }
      if (flow.goes_to(seat)) {
        readers_.push_back(vendor_->open_reader(flow, arrivals_));
        bytes_per_round_ += flow.payload.size();
      }
    }
    await_matches();
  }

  void write() {
    for (const auto& writer : writers_) writer->write();
  }

  /// Waits until this process has received all samples of rounds 1 to `round` that are sent to it.
  /// @throws std::runtime_error after kRoundLimit.
  void await(std::uint64_t round) {
    if (!arrivals_.wait_for(round * readers_.size(), kRoundLimit)) {
      throw std::runtime_error("round " + std::to_string(round) +
                               ": a process still waits for messages after a minute");
    }
  }

  /// Checks that this process has received as many bytes as the writers send to it in `rounds` rounds. Does not compare
  /// the values of the bytes. @throws std::runtime_error if the numbers differ.
  void check_bytes(std::uint64_t rounds) const {
    if (arrivals_.bytes() != rounds * bytes_per_round_)
      throw std::runtime_error("a process received another number of bytes than the others sent to it");
  }

 private:
  void await_matches() {
    const auto deadline = Clock::now() + kRoundLimit;
    const auto complete = [&] {
      bool all = std::ranges::all_of(readers_, [](const auto& reader) { return reader->matched() >= 1; });
      for (std::size_t i = 0; i < writers_.size(); ++i) all = all && writers_[i]->matched() >= expected_matches_[i];
      return all;
    };
    while (!complete()) {
      if (Clock::now() > deadline)
        throw std::runtime_error("the processes have not matched their DDS writers and readers within a minute");
      arrivals_.wait_for(1, kMatchPoll);
    }
  }

  Arrivals arrivals_;
  std::unique_ptr<Vendor> vendor_;
  std::vector<std::unique_ptr<Endpoint>> writers_, readers_;
  std::vector<std::size_t> expected_matches_;
  std::uint64_t bytes_per_round_ = 0;
};

/// The parent's handle of a child process that takes one seat. The child writes to a pipe: one byte when all its
/// endpoints are matched, and at the end its CPU time in the measured rounds [s].
class Child {
 public:
  Child(const Seat& seat, const std::vector<Flow>& flows, std::uint64_t rounds) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("cannot create a pipe to a child process");
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork a child process");
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      ::close(ends[0]);
      ::_exit(::getppid() == parent ? take_part(seat, flows, rounds, ends[1]) : 3);
    }
    ::close(ends[1]);
    pipe_ = ends[0];
  }
  ~Child() {
    if (pid_ > 0) ::kill(pid_, SIGKILL);
    if (pid_ > 0) ::waitpid(pid_, nullptr, 0);
    if (pipe_ >= 0) ::close(pipe_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void await_ready() { read_all<char>(); }
  /// Waits for the child's last round. @returns the child's CPU time in the rounds after the warm-up [s].
  double await_end() { return read_all<double>(); }

 private:
  static int take_part(const Seat& seat, const std::vector<Flow>& flows, std::uint64_t rounds, int pipe) try {
    Participant participant(seat, flows);
    const char ready = 1;
    if (::write(pipe, &ready, 1) != 1) return 3;
    double before_s = 0.0;
    for (std::uint64_t round = 1; round <= kWarmUp + rounds; ++round) {
      participant.await(round);
      participant.write();
      if (round == kWarmUp) before_s = process_cpu_s();
    }
    participant.check_bytes(kWarmUp + rounds);
    const double cpu_s = process_cpu_s() - before_s;
    if (::write(pipe, &cpu_s, sizeof cpu_s) != sizeof cpu_s) return 3;
    // If this process exited now, DDS would drop those of its last samples that it has not delivered yet. So the
    // process waits until its parent kills it (~Child).
    for (;;) ::pause();
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 3;
  }

  template <class T>
  T read_all() const {
    T value{};
    if (::read(pipe_, &value, sizeof value) != sizeof value) throw std::runtime_error("a child process failed");
    return value;
  }

  pid_t pid_ = -1;
  int pipe_ = -1;
};

}  // namespace

void Arrivals::add(std::uint64_t samples, std::uint64_t bytes) {
  const std::scoped_lock lock(mutex_);
  samples_ += samples;
  bytes_ += bytes;
  if (samples_ >= wanted_) changed_.notify_one();
}

bool Arrivals::wait_for(std::uint64_t samples, std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  wanted_ = samples;
  return changed_.wait_for(lock, limit, [&] { return samples_ >= wanted_; });
}

std::uint64_t Arrivals::bytes() const {
  const std::scoped_lock lock(mutex_);
  return bytes_;
}

FloorResult run_floor(const FloorOptions& options) {
  const std::vector<Flow> flows = round_flows(options.uavs, options.base_domain);
  const std::vector<Seat> all = seats(options.uavs);
  std::vector<std::unique_ptr<Child>> children;
  for (std::size_t i = 1; i < all.size(); ++i) {
    children.push_back(std::make_unique<Child>(all[i], flows, options.rounds));
  }
  Participant server(all.front(), flows);
  for (const auto& child : children) child->await_ready();

  const auto run_rounds = [&](std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t round = first; round <= last; ++round) {
      server.write();
      server.await(round);
    }
  };
  run_rounds(1, kWarmUp);
  const auto began = Clock::now();
  const double before_s = process_cpu_s();
  run_rounds(kWarmUp + 1, kWarmUp + options.rounds);
  FloorResult result;
  result.rounds = options.rounds;
  result.wall_s = std::chrono::duration<double>(Clock::now() - began).count();
  result.cpu_s = result.server_cpu_s = process_cpu_s() - before_s;
  for (const auto& child : children) result.cpu_s += child->await_end();
  server.check_bytes(kWarmUp + options.rounds);
  for (const Flow& flow : flows) {
    result.messages += flow.readers.size();
    result.bytes += flow.readers.size() * flow.payload.size();
  }
  return result;
}

}  // namespace skein::bench
