// bench_chatter: a UAV's program that only exchanges radio messages, for `skein bench` and for tests. It registers one
// unicast radio topic to every other node, with a type that exists nowhere else, receives the messages of the others,
// and sends on each topic in every step.
//   skein run FILE --planner exec:bench_chatter        (the launcher sets SKEIN_DOMAIN, SKEIN_UAV, SKEIN_DDS, ...)
// Each message contains its number. A message that arrives twice, out of order or damaged ends the program with exit
// code 3; otherwise its last line on stdout is JSON: the number of messages received.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <iostream>

#include "bus/lockstep/client_node.hpp"
#include "bus/lockstep/radio_topics.hpp"
#include "bus/program_bus.hpp"
#include "core/scenario/scenario_reader.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;
const std::string kType = "skein_bench/msg/Chatter";
constexpr std::size_t kHeader = 4;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr)
    throw skein::InputError(std::string("bench_chatter: ") + name + " is not set; run it by skein run");
  return value;
}

/// Message number n: encapsulation header, the number, and bytes that are computed from it.
Bytes message(std::uint64_t n, std::size_t size) {
  Bytes bytes(kHeader + size);
  bytes[1] = 1;
  for (std::size_t i = 0; i < size; ++i) {
    bytes[kHeader + i] = static_cast<std::uint8_t>(i < 8 ? n >> (8 * i) : (n + i) * 31);
  }
  return bytes;
}

std::uint64_t number_of(const Bytes& bytes) {
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < 8 && kHeader + i < bytes.size(); ++i) n |= std::uint64_t{bytes[kHeader + i]} << (8 * i);
  return n;
}

class Chatter final : public skein::bus::ClientNode {
 public:
  Chatter(const skein::Scenario& scenario, const skein::bus::Bus& bus, skein::bus::Participant& participant,
          std::string uav, std::size_t bytes)
      : uav_(std::move(uav)),
        bytes_(bytes),
        inbox_(bus.run()),
        client_(participant, inbox_, uav_),
        radio_(client_, uav_) {
    for (const skein::Node node : scenario.nodes()) {
      if (scenario.node_name(node) != uav_) others_.push_back(scenario.node_name(node));
    }
  }

  skein::bus::Inbox& inbox() override { return inbox_; }
  int run() {
    const int code = skein::bus::exit_code(skein::bus::run_node(*this), uav_);
    std::cout << nlohmann::json{{"heard", heard_}} << std::endl;
    return code;
  }

 private:
  static std::string topic(const std::string& from, const std::string& to) { return "/chatter_" + from + "_" + to; }

  skein::bus::LockstepClient& client() override { return client_; }
  bool answered_last() const override { return last_; }
  void think() override {
    const std::uint64_t k = client_.step().k();
    radio_.begin_step();
    if (!started_) {
      for (const std::string& other : others_) {
        radio_.send(topic(uav_, other), kType, {other});
        radio_.listen(topic(other, uav_), kType,
                      [this, other](skein::bus::Sample&& sample) { hear(other, sample.payload); });
      }
    }
    started_ = true;
    const Bytes bytes = message(k, bytes_);
    for (const std::string& other : others_) radio_.write(topic(uav_, other), bytes);
    client_.done();
    last_ = client_.step().final_step();
  }

  void hear(const std::string& from, const Bytes& bytes) {
    const std::uint64_t n = number_of(bytes);
    Bytes expected = message(n, bytes_);
    expected.resize((expected.size() + 3) / 4 * 4);
    if (bytes != expected) throw std::runtime_error("a damaged message came from " + from);
    const auto [last, first] = last_heard_.try_emplace(from, n);
    if (!first && n <= last->second) throw std::runtime_error("a message came twice or late from " + from);
    last->second = n;
    ++heard_;
  }

  const std::string uav_;
  const std::size_t bytes_;
  std::vector<std::string> others_;
  skein::bus::Inbox inbox_;
  skein::bus::LockstepClient client_;
  skein::bus::RadioTopics radio_;
  std::map<std::string, std::uint64_t> last_heard_;
  std::uint64_t heard_ = 0;
  bool started_ = false, last_ = false;
};

}  // namespace

int main(int argc, char** argv) try {
  std::size_t bytes = 200;
  CLI::App app("Talks to every other node in every step");
  app.add_option("--bytes", bytes, "Size of each message [bytes]")->check(CLI::Range(8, 4'000'000));
  CLI11_PARSE(app, argc, argv);
  const skein::Scenario scenario = skein::load_scenario(variable("SKEIN_SCENARIO"), {.needs_scene_files = false});
  const auto bus =
      skein::bus::make_bus({.vendor = variable("SKEIN_DDS"), .run = skein::RunId{std::stoull(variable("SKEIN_RUN"))}});
  const auto participant = bus->join(std::stoi(variable("SKEIN_DOMAIN")));
  return Chatter(scenario, *bus, *participant, variable("SKEIN_UAV"), bytes).run();
} catch (const std::exception& error) {
  std::cerr << error.what() << std::endl;
  return skein::kExitProcessFailed;
}
