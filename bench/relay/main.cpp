// bench_relay: measures the time of a radio message through comm_router, and through a bare relay: a process that only
// copies messages from one domain to another, over the same vendor. Measures both in turn, message by message, in one
// run; prints one line of JSON on stdout. The clock starts just before the last sample that the router needs is written
// (the sender's Done; for the bare relay: the message) and stops in the callback of a reader in the target's domain.
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <thread>

#include "bus/lockstep/client.hpp"
#include "bus/lockstep/names.hpp"
#include "bus/lockstep/server.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "process/program.hpp"

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;
using skein::bus::LockstepClient;
namespace topics = skein::topics;

constexpr auto kPatience = 30s;
const skein::bus::TopicSpec kBare{"rt/bare", "std_msgs::msg::dds_::String_", {}};

struct Options {
  std::string dds = "cyclonedds", scenario;
  std::filesystem::path router, out;
  int domain = 0, messages = 1000;
  std::size_t bytes = 200;
};

/// A child process. It dies with this process at the latest.
class Child {
 public:
  template <class Work>
  explicit Child(Work work) : pid_(::fork()) {
    if (pid_ < 0) throw std::runtime_error("no process");
    if (pid_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    work();
    ::_exit(3);
  }
  ~Child() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

 private:
  const pid_t pid_;
};

/// The bare relay: writes each sample that it reads in one domain in the next domain, on the vendor's own thread.
void relay(const Options& options) {
  const auto bus = skein::bus::make_bus({.vendor = options.dds});
  const auto from = bus->join(options.domain + 3), to = bus->join(options.domain + 4);
  const auto writer = to->create_writer(kBare);
  const auto reader = from->create_reader(kBare, [&](skein::bus::Sample&& sample) { writer->write(sample.payload); });
  for (;;) ::pause();
}

void exec_router(const Options& options) {
  const std::string domain = std::to_string(options.domain);
  ::execl(options.router.c_str(), options.router.c_str(), "--scenario", options.scenario.c_str(), "--domain",
          domain.c_str(), "--dds", options.dds.c_str(), "--out", options.out.c_str(), nullptr);
}

/// A reader that records when the last message arrived.
class Ear {
 public:
  Ear(skein::bus::Participant& participant, const skein::bus::TopicSpec& topic)
      : reader_(participant.create_reader(topic, [this](skein::bus::Sample&&) {
          arrived_at_ = Clock::now();
          ++count_;
        })) {}
  std::uint64_t count() const { return count_; }
  Clock::time_point arrived_at() const { return arrived_at_; }
  bool matched() const { return !reader_->matched().empty(); }

 private:
  std::atomic<std::uint64_t> count_ = 0;
  Clock::time_point arrived_at_;
  std::unique_ptr<skein::bus::Reader> reader_;
};

void wait_until(const char* what, auto condition) {
  const auto deadline = Clock::now() + kPatience;
  while (!condition()) {
    if (Clock::now() > deadline) throw std::runtime_error(std::string("waited in vain for ") + what);
    std::this_thread::yield();
  }
}

double microseconds(Clock::duration time) { return std::chrono::duration<double, std::micro>(time).count(); }

/// A fleet of one UAV and the station, without physics: server and members in this process, the router beside it.
class Fleet {
 public:
  Fleet(const Options& options, const skein::Scenario& scenario)
      : bus_(skein::bus::make_bus({.vendor = options.dds})),
        message_(options.bytes),
        world_(bus_->join(skein::world_domain(options.domain))),
        gcs_(bus_->join(skein::gcs_domain(options.domain))),
        uav_(bus_->join(skein::uav_domain(options.domain, skein::UavIndex{0}))),
        ear_domain_(bus_->join(skein::gcs_domain(options.domain))),
        ear_(*ear_domain_, {"rt/plan/gcs", kBare.type, {.depth = 1024}}),
        server_(inbox_),
        sender_(*uav_, inbox_, scenario.fleet[0].name),
        station_(*gcs_, inbox_, std::string(skein::bus::kStationName)) {
    message_[1] = 1;  // CDR_LE
    const auto world = server_.add_domain("", *world_);
    server_.add_place(std::string(skein::bus::kRouterName), world, true);
    server_.add_place(std::string(skein::bus::kStationName), server_.add_domain("gcs", *gcs_peer(options)), true);
    server_.add_place(scenario.fleet[0].name, server_.add_domain(scenario.fleet[0].name, *uav_peer(options)), true);
    sender_.declare_writer({"rt/plan", kBare.type, {.depth = topics::kRadioDepth}},
                           LockstepClient::Counterpart::router);
    sender_.start();
    station_.start();
  }

  /// Sends messages until the router's writer has matched the ear: the lock-step does not wait for a non-member.
  void find_ear() {
    wait_until("the ear", [&] {
      const std::uint64_t before = ear_.count();
      exchange(false);
      const auto pause_end = Clock::now() + 20ms;
      while (Clock::now() < pause_end && ear_.count() == before) std::this_thread::yield();
      return ear_.count() > before;
    });
  }

  /// One step with one message. @returns the message's time through the router [us].
  double step(bool last) {
    const std::uint64_t before = ear_.count();
    const Clock::time_point written = exchange(last);
    wait_until("the router", [&] { return ear_.count() > before; });
    return microseconds(ear_.arrived_at() - written);
  }

 private:
  /// @returns the time just before the sender's Done was written.
  Clock::time_point exchange(bool last) {
    wait_until("the fleet", [&] {
      inbox_.dispatch(0ms);
      poll(sender_);
      poll(station_);
      return server_.at_boundary();
    });
    server_.publish({.k = k_, .tick = 20 * static_cast<skein::Tick>(k_), .links = {0, 1, 1, 0}, .final_step = last});
    ++k_;
    Clock::time_point written;
    wait_until("both members", [&] {
      inbox_.dispatch(0ms);
      const bool station_thinks = poll(station_), sender_thinks = poll(sender_);
      thinking_ += station_thinks + sender_thinks;
      if (thinking_ < 2) return false;
      sender_.write("rt/plan", message_);
      station_.done();
      written = Clock::now();
      sender_.done();
      return true;
    });
    thinking_ = 0;
    wait_until("the answers", [&] {
      inbox_.dispatch(0ms);
      return server_.answered();
    });
    return written;
  }

  skein::bus::Participant* gcs_peer(const Options& options) {
    server_gcs_ = bus_->join(skein::gcs_domain(options.domain));
    return server_gcs_.get();
  }
  skein::bus::Participant* uav_peer(const Options& options) {
    server_uav_ = bus_->join(skein::uav_domain(options.domain, skein::UavIndex{0}));
    return server_uav_.get();
  }
  static bool poll(LockstepClient& client) { return client.poll() == LockstepClient::Event::think; }

  std::unique_ptr<skein::bus::Bus> bus_;
  Bytes message_;
  skein::bus::Inbox inbox_{0};
  std::unique_ptr<skein::bus::Participant> world_, gcs_, uav_, ear_domain_, server_gcs_, server_uav_;
  Ear ear_;
  skein::bus::LockstepServer server_;
  LockstepClient sender_, station_;
  std::uint64_t k_ = 0;
  int thinking_ = 0;
};

/// The same message through the bare relay.
class Bare {
 public:
  explicit Bare(const Options& options)
      : bus_(skein::bus::make_bus({.vendor = options.dds})),
        message_(options.bytes),
        here_(bus_->join(options.domain + 3)),
        there_(bus_->join(options.domain + 4)),
        writer_(here_->create_writer(kBare)),
        ear_(*there_, kBare) {
    message_[1] = 1;
    wait_until("the relay's endpoints", [&] { return ear_.matched() && !writer_->matched().empty(); });
    // The relay discovers its side of the matches later: send until a message arrives, then wait for the rest.
    std::uint64_t asked = 0;
    wait_until("the relay", [&] {
      writer_->write(message_);
      ++asked;
      const auto pause_end = Clock::now() + 5ms;
      while (Clock::now() < pause_end && ear_.count() == 0) std::this_thread::yield();
      return ear_.count() > 0;
    });
    const auto quiet = Clock::now() + 100ms;
    while (Clock::now() < quiet && ear_.count() < asked) std::this_thread::yield();
  }

  /// @returns the message's time through the bare relay [us].
  double message() {
    const std::uint64_t before = ear_.count();
    const Clock::time_point written = Clock::now();
    writer_->write(message_);
    wait_until("the relay", [&] { return ear_.count() > before; });
    return microseconds(ear_.arrived_at() - written);
  }

 private:
  std::unique_ptr<skein::bus::Bus> bus_;
  Bytes message_;
  std::unique_ptr<skein::bus::Participant> here_, there_;
  std::unique_ptr<skein::bus::Writer> writer_;
  Ear ear_;
};

nlohmann::json figures(std::vector<double> times) {
  std::ranges::sort(times);
  const auto quantile = [&](double q) {
    return times[static_cast<std::size_t>(q * static_cast<double>(times.size() - 1))];
  };
  return {{"median", quantile(0.5)}, {"p10", quantile(0.1)}, {"p90", quantile(0.9)}};
}

int run(const Options& options) {
  const skein::Scenario scenario = skein::load_scenario(options.scenario, {.needs_scene_files = false});
  if (scenario.fleet.size() != 1) throw skein::InputError("bench_relay: the scenario must have one UAV");
  const Child relay_process([&] { relay(options); });
  const Child router_process([&] { exec_router(options); });
  Fleet fleet(options, scenario);
  Bare bare(options);
  fleet.find_ear();
  std::vector<double> through_router, through_relay;
  for (int i = 0; i < options.messages; ++i) {
    const double router_us = fleet.step(i + 1 == options.messages), relay_us = bare.message();
    if (i < options.messages / 10) continue;  // warm-up
    through_router.push_back(router_us);
    through_relay.push_back(relay_us);
  }
  const nlohmann::json router = figures(through_router), relayed = figures(through_relay);
  std::cout << nlohmann::json{{"vendor", options.dds},
                              {"bytes", options.bytes},
                              {"messages", through_router.size()},
                              {"router_us", router},
                              {"relay_us", relayed},
                              {"times_relay", router["median"].get<double>() / relayed["median"].get<double>()}}
            << std::endl;
  return skein::kExitDone;
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app("Radio latency through comm_router and through a bare relay");
  app.add_option("--dds", options.dds, "Vendor");
  app.add_option("--scenario", options.scenario, "With one UAV")->required();
  app.add_option("--router", options.router, "The program comm_router")->required();
  app.add_option("--out", options.out, "Folder for what it writes")->required();
  app.add_option("--domain", options.domain, "The first of five DDS domains")->check(CLI::Range(0, 200));
  app.add_option("--messages", options.messages, "Number of messages")->check(CLI::Range(20, 1'000'000));
  app.add_option("--bytes", options.bytes, "Size of each message [bytes]")->check(CLI::Range(8, 4'000'000));
  CLI11_PARSE(app, argc, argv);
  return run(options);
} catch (const std::exception& error) {
  std::cerr << error.what() << std::endl;
  return skein::kExitProcessFailed;
}
