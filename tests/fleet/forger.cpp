// A program at the ground station that poses as the station: in every step it acknowledges a thousand captures of every
// UAV, which the UAVs would then erase from their cards. It takes part in the lock-step as "gcs", as it should.
//   skein run --planner patrol,gcs=exec:"forger UAV..."    (the launcher sets SKEIN_RUN, SKEIN_DOMAIN, SKEIN_DDS)
#include <cstdlib>
#include <exception>
#include <iostream>

#include "bus/lockstep/client_loop.hpp"
#include "bus/lockstep/names.hpp"
#include "core/radio_routes.hpp"

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

int forge(const std::vector<std::string>& uavs) {
  using skein::bus::LockstepClient;
  const auto bus = skein::bus::make_bus({.vendor = variable("SKEIN_DDS"),
                                         .security = variable("SKEIN_SECURITY"),
                                         .run = skein::RunId{std::stoull(variable("SKEIN_RUN"))}});
  const auto participant = bus->join(std::stoi(variable("SKEIN_DOMAIN")));
  skein::bus::Inbox inbox(bus->run());
  LockstepClient client(*participant, inbox, std::string(skein::bus::kGcsName));
  for (const std::string& uav : uavs) {
    client.declare_writer(skein::bus::spec(skein::topics::captures_ack(uav)), LockstepClient::Counterpart::router);
  }
  bool last = false;
  const auto think = [&] {
    for (const std::string& uav : uavs) {
      skein::msg::CaptureAck ack;
      ack.uav(uav);
      for (std::uint64_t capture = 0; capture < 1000; ++capture) ack.captures().push_back(capture);
      client.write(skein::topics::captures_ack(uav).name, ack);
    }
    client.done();
    last = client.step().final_step();
  };
  const skein::StopSignal stop;
  const skein::bus::ClientLoop loop{.think = think, .answered_last = [&] { return last; }};
  return skein::bus::exit_code(skein::bus::run_client(client, inbox, loop, stop), "forger");
}

}  // namespace

int main(int argc, char** argv) try { return forge({argv + 1, argv + argc}); } catch (const std::exception& error) {
  std::cerr << error.what() << std::endl;
  return 3;
}
