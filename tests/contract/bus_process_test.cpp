// The contract of every backend if the other process is paused or killed.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "tests/contract/bus_fixture.hpp"
#include "tests/free_domain.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

using bus::Participant;
using bus::ParticipantId;
using bus::Sample;

/// bus_contract_peer as a child process; killed at the end.
class Peer {
 public:
  Peer(const std::string& vendor, int domain) {
    std::string program = helper_program("bus_contract_peer"), vendor_arg = vendor, domain_arg = std::to_string(domain);
    char* const argv[] = {program.data(), vendor_arg.data(), domain_arg.data(), nullptr};
    if (posix_spawn(&pid_, program.c_str(), nullptr, nullptr, argv, environ) != 0)
      throw std::runtime_error("cannot start " + program);
  }
  ~Peer() { kill(); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// Pauses it. Returns when all its threads are stopped.
  void stop() {
    ::kill(pid_, SIGSTOP);
    waitpid(pid_, nullptr, WUNTRACED);
  }
  void resume() { ::kill(pid_, SIGCONT); }
  void kill() {
    if (pid_ == 0) return;
    ::kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }

 private:
  pid_t pid_ = 0;
};

/// Resident memory of this process [MB].
double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Names of the vendors' shared memory in /dev/shm.
std::set<std::string> shared_memory() {
  std::set<std::string> names;
  if (!std::filesystem::exists("/dev/shm")) return names;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
    const std::string name = entry.path().filename();
    for (const char* mark : {"fast", "cdds", "cyclone", "iceoryx", "iox", "roudi"})
      if (name.find(mark) != std::string::npos) names.insert(name);
  }
  return names;
}

class BusProcesses : public testing::TestWithParam<Pair> {
 protected:
  /// The peer reads the writer's topic, and so does a second reader in this process.
  void SetUp() override {
    self_ = bus::make_bus({.vendor = GetParam().writer})->join(domains_.base());
    writer_ = self_->create_writer(topic("to_peer"));
    answers_ = self_->create_reader(topic("from_peer"), heard_.callback());
    hello_ = self_->create_reader(topic("hello", {.latched = true, .depth = 1}), introduced_.callback());
    live_ = bus::make_bus({.vendor = GetParam().reader})->join(domains_.base());
    live_reader_ = live_->create_reader(topic("to_peer"), [keep = live_got_.callback()](Sample&& sample) {
      sample.payload = {sample.payload.begin(), sample.payload.begin() + 12};  // the test measures memory
      keep(std::move(sample));
    });
    const auto hello = introduced_.wait_for(1);
    ASSERT_EQ(hello.size(), 1u);
    peer_id_ = hello[0].source;
    ASSERT_EQ(peer_id_, number_of(hello[0].payload));
    ASSERT_TRUE(eventually([&] { return writer_->matched().size() == 2 && !live_reader_->matched().empty(); }));
  }

  /// Waits for an answer of the peer, because a match on this side does not imply one on the other. Returns when all
  /// answers have arrived.
  void connect_both_ways() {
    std::uint64_t written = 0;
    ASSERT_TRUE(eventually([&] {
      writer_->write(numbered(++written));
      return !heard_.wait_for(0).empty();
    }));
    ASSERT_TRUE(eventually([&] { return heard_.numbers(0).back() == written; }));
  }

  /// Writes rounds of 50 samples, each when the live reader has received the one before.
  void write_in_step(std::size_t count) {
    while (written_ < count) {
      for (int i = 0; i < 50 && written_ < count; ++i) writer_->write(numbered(written_++, 2000));
      ASSERT_EQ(live_got_.wait_for(written_).size(), written_);
    }
  }

  FreeDomains domains_{1};
  Peer peer_{GetParam().reader, domains_.base()};
  Collector heard_, introduced_, live_got_;
  std::unique_ptr<Participant> self_, live_;
  std::unique_ptr<bus::Writer> writer_;
  std::unique_ptr<bus::Reader> answers_, hello_, live_reader_;
  ParticipantId peer_id_ = 0;
  std::size_t written_ = 0;
};

TEST_P(BusProcesses, SamplesOfAnotherProcessArriveInOrder) {
  connect_both_ways();
  const std::size_t before = heard_.wait_for(0).size();
  for (std::uint64_t n = 0; n < 50; ++n) writer_->write(numbered(n, 2000));
  const auto numbers = heard_.numbers(before + 50);
  ASSERT_EQ(numbers.size(), before + 50);
  for (std::uint64_t n = 0; n < 50; ++n) EXPECT_EQ(numbers[before + n], n);
  for (const auto& sample : heard_.wait_for(0)) EXPECT_EQ(sample.source, peer_id_);
}

TEST_P(BusProcesses, LargeSamplesOfAnotherProcessArrive) {
  connect_both_ways();
  for (const std::size_t size : {60'000, 200'000, 1'000'000, 4'000'000, 4'000'000}) {
    const std::size_t before = heard_.wait_for(0).size();
    writer_->write(numbered(size, size));
    const auto samples = heard_.wait_for(before + 1);
    ASSERT_EQ(samples.size(), before + 1);
    EXPECT_TRUE(samples.back().payload == numbered(size, size)) << size;
  }
}

TEST_P(BusProcesses, AStoppedReaderDoesNotDelayTheWriter) {
  peer_.stop();
  write_in_step(2000);
  [[maybe_unused]] const double before = resident_mb();
  for (std::uint64_t n = 0; n < 50'000; ++n) writer_->write(numbered(n, 2000));
#ifndef __SANITIZE_ADDRESS__  // AddressSanitizer keeps freed memory for a while
  EXPECT_LT(resident_mb() - before, 50.0)
      << "the writer keeps all samples that the stopped reader has not acknowledged";
#endif
  peer_.resume();
}

TEST_P(BusProcesses, AKilledReaderDoesNotDelayTheWriterAndNoLongerMatches) {
  const auto before = shared_memory();
  peer_.kill();
  write_in_step(2000);
  EXPECT_TRUE(eventually([&] { return writer_->matched() == std::vector<ParticipantId>{live_->id()}; }));
  EXPECT_TRUE(eventually([&] { return answers_->matched().empty(); }));
  for (const auto& name : shared_memory()) EXPECT_TRUE(before.contains(name)) << name << " is left in /dev/shm";
}

INSTANTIATE_TEST_SUITE_P(Vendors, BusProcesses,
                         testing::Values(Pair{"cyclonedds", "cyclonedds"}, Pair{"fastdds", "fastdds"},
                                         Pair{"cyclonedds", "fastdds"}, Pair{"fastdds", "cyclonedds"}),
                         [](const auto& pair) { return name_of(pair.param); });

}  // namespace
}  // namespace skein::test
