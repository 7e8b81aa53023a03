// A program at the ground station that poses as the station: in every step it acknowledges a thousand captures of every
// UAV, which the UAVs would then erase from their cards. It takes part in the lock-step as "gcs", as it should.
//   skein run --planner patrol,gcs=exec:"forger UAV..."    (the launcher sets SKEIN_RUN, SKEIN_DOMAIN, SKEIN_DDS)
#include <cstdlib>
#include <exception>
#include <iostream>
#include <numeric>

#include "bus/lockstep/client_node.hpp"
#include "bus/lockstep/names.hpp"
#include "core/radio/radio_routes.hpp"
#include "idl/conversions.hpp"

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

class Forger final : public skein::bus::ClientNode {
 public:
  Forger(const skein::bus::Bus& bus, skein::bus::Participant& participant, std::vector<std::string> uavs)
      : uavs_(std::move(uavs)), inbox_(bus.run()), client_(participant, inbox_, std::string(skein::bus::kGcsName)) {
    for (const std::string& uav : uavs_) {
      client_.declare_writer(skein::bus::spec(skein::topics::captures_ack(uav)),
                             skein::bus::LockstepClient::Counterpart::router);
    }
  }
  skein::bus::Inbox& inbox() override { return inbox_; }

 private:
  skein::bus::LockstepClient& client() override { return client_; }
  void think() override {
    for (const std::string& uav : uavs_) {
      std::vector<std::uint64_t> captures(1000);
      std::iota(captures.begin(), captures.end(), 0U);
      client_.write(skein::topics::captures_ack(uav).name, skein::to_capture_ack(uav, captures));
    }
    client_.done();
    last_ = client_.step().final_step();
  }
  bool answered_last() const override { return last_; }

  const std::vector<std::string> uavs_;
  skein::bus::Inbox inbox_;
  skein::bus::LockstepClient client_;
  bool last_ = false;
};

int forge(const std::vector<std::string>& uavs) {
  const auto bus = skein::bus::make_bus({.vendor = variable("SKEIN_DDS"),
                                         .security = variable("SKEIN_SECURITY"),
                                         .run = skein::RunId{std::stoull(variable("SKEIN_RUN"))}});
  const auto participant = bus->join(std::stoi(variable("SKEIN_DOMAIN")));
  Forger forger(*bus, *participant, uavs);
  return skein::bus::exit_code(skein::bus::run_node(forger), "forger");
}

}  // namespace

int main(int argc, char** argv) try { return forge({argv + 1, argv + argc}); } catch (const std::exception& error) {
  std::cerr << error.what() << std::endl;
  return 3;
}
