// A program in a UAV's container can reach server and router in its own domain, and nothing else.
#include <signal.h>

#include <algorithm>
#include <regex>

#include "container_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

const std::string kSpy = "jurong", kAgent = "uav_agent-jurong";
constexpr int kSpysDomain = 3;                      // world 1, ground station 2, UAVs from 3 on
constexpr const char* kOthersDomains = " 1 2 4 5";  // of the world, the station and two other UAVs

class Isolation : public Containers {
 protected:
  /// Addresses of all containers in the networks to which the spy's container is not connected.
  static std::vector<std::string> foreign_addresses(const SkeinRun& run) {
    std::vector<std::string> foreign;
    for (const std::string& program : kPrograms) {
      const Answer networks = shell(
          "docker inspect --format '{{range $name, $net := .NetworkSettings.Networks}}{{$name}} "
          "{{$net.IPAddress}} {{end}}' " +
          container(run, program));
      const std::vector<std::string> all = words(networks.text);
      for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
        if (!all[i].ends_with("_" + kSpy)) foreign.push_back(all[i + 1]);
      }
    }
    return foreign;
  }
};

// A single script, to save time. It prints each thing that it can see or do although it must not. A reachable host
// refuses a connection to a closed port; if there is no answer at all, the host is not reachable.
constexpr const char* kSpying = R"sh(
expect() { [ "$2" = "$3" ] || echo "$1: $2, not $3"; }
expect interfaces "$(ls /sys/class/net | grep -E -v '^(lo|tunl0|sit0|ip6tnl0)$' | tr '\n' ' ')" "eth0 "
probe() {
  said=$(timeout 1 bash -c "exec 3<> /dev/$1/$2/9 && echo x >&3 && sleep 0.3 && echo x >&3" 2>&1)
  end=$?
  case "$end $said" in
    *refused*) echo "$1 reaches $2" ;;
    124*|*"Network is unreachable"*|*"No route to host"*) ;;
    0*) [ $1 = udp ] || echo "$1 reaches $2" ;;
    *) echo "$1 to $2: $said" ;;
  esac
}
for protocol in tcp udp; do
  # The kernel sends few refusals a second, and DDS on closed ports may have had them.
  for attempt in 1 2 3 4 5 6 7 8 9 10; do
    said=$(probe $protocol sim.$SPY)
    [ -n "$said" ] && break
    sleep 1
  done
  expect "what is said of an address that is there" "$said" "$protocol reaches sim.$SPY"
  for address in $ADDRESSES; do probe $protocol $address & done
done
for name in $NAMES; do getent hosts $name & done
getent hosts sim.$SPY > /dev/null || echo "cannot resolve sim.$SPY: names were not tested"
wait
for set in CapInh CapPrm CapEff CapBnd CapAmb; do
  expect $set "$(sed -n "s/^$set:[[:space:]]*//p" /proc/1/status)" 0000000000000000
done
expect NoNewPrivs "$(sed -n 's/^NoNewPrivs:[[:space:]]*//p' /proc/1/status)" 1
[ "$(sed -n 's/^Uid:[[:space:]]*\([0-9]*\).*/\1/p' /proc/1/status)" = 0 ] && echo "is root"
for folder in / /etc /usr /opt /var; do ( : > $folder/mine ) 2> /dev/null && echo "writes to $folder"; done
find /results -type f ! -name "uav_agent-$SPY.*"
find / \( -path /proc -o -path /sys \) -prune -o -type f \
  \( -name scene.json -o -name captures.csv -o -name station.journal -o -name trajectories.csv \) -print 2> /dev/null
true
)sh";

TEST_F(Isolation, AUavSeesItsOwnDomainAndNothingElse) {
  SkeinRun& run = start_up("up", arguments("patrol", "3600"));
  const std::string spy = flying(run, kAgent);
  std::string addresses, names = "station";
  for (const std::string& address : foreign_addresses(run)) addresses += " " + address;
  EXPECT_EQ(words(addresses).size(), 2u * 6u + 2u + 4u)
      << "addresses of server, router, station and UAVs: " << addresses;
  // The address of each network's gateway, which would be this host, also in the spy's own network.
  for (const std::string& network :
       words(shell("docker network ls --quiet --filter label=com.docker.compose.project=" + project(run)).text)) {
    addresses += " " + shell("docker network inspect --format '{{(index .IPAM.Config 0).Gateway}}' " + network).text;
  }
  EXPECT_EQ(words(addresses).size(), 18u + 7u) << addresses;
  for (const std::string& uav : kFleet) {
    if (uav != kSpy) names += " uav_agent-" + uav + " uav." + uav;
  }
  for (const char* network : {".world", ".gcs", ".raffles"}) {
    for (const char* role : {"sim", "router", "station"}) names += std::string(" ") + role + network;
  }
  const fs::path script =
      write("spying.sh", "SPY=" + kSpy + "\nADDRESSES='" + addresses + "'\nNAMES='" + names + "'\n" + kSpying);
  const Answer found = shell("docker exec --interactive " + spy + " bash -s < " + script.string());
  EXPECT_EQ(found.code, 0);
  EXPECT_EQ(found.text, "");
  for (const char* gateway : {"sim_server", "comm_router"}) {
    EXPECT_EQ(shell("docker exec " + container(run, gateway) + " cat /proc/sys/net/ipv4/ip_forward").text, "0")
        << gateway;
  }
  run.skein().signal(SIGINT);
  EXPECT_EQ(run.exit_code(), 130) << run.err();
}

class Intruder : public Isolation, public testing::WithParamInterface<std::string> {};

// The intruder sends to the server and the router, which are in all domains, over the network that it shares with them.
TEST_P(Intruder, HearsNothingOfOtherDomainsAndIsNotHeardThere) {
  SkeinRun& run = start_up("up", arguments("patrol", "300", {"--dds", GetParam()}));
  const std::string spy = container(run, kAgent);
  fs::copy_file(helper_program("container_intruder"), run.dir() / "agents" / kSpy / "intruder");
  const std::string compose = text_of(run.dir() / "compose.yaml");
  std::smatch run_id;
  ASSERT_TRUE(std::regex_search(compose, run_id, std::regex("--run=(\\d+)")));
  const std::string near = "sim." + kSpy + ", router." + kSpy;
  std::string far = near;
  for (const std::string& address : foreign_addresses(run)) far += ", " + address;
  const std::string network = "'{own: {peers: [" + near + "]}, usual: {peers: [" + far + "]}}'";
  const Answer heard = shell("docker exec " + spy + " /results/intruder " + GetParam() + " " + run_id[1].str() + " " +
                             network + " " + std::to_string(kSpysDomain) + kOthersDomains);
  fs::remove(run.dir() / "agents" / kSpy / "intruder");
  EXPECT_EQ(heard.code, 0) << heard.text;
  std::istringstream lines(heard.text);
  std::size_t domains = 0;
  for (std::string line; std::getline(lines, line); ++domains) {
    long domain = 0, readers = 0, writers = 0, samples = 0;
    std::istringstream(line) >> domain >> readers >> writers >> samples;
    if (domain == kSpysDomain) {
      EXPECT_GT(samples, 0) << "the intruder does not work, even in its own domain: " << line;
    } else {
      EXPECT_EQ(readers, 0) << "these readers would receive forged samples: " << line;
      EXPECT_EQ(samples, 0) << line;
      EXPECT_EQ(writers, 0) << "discovery of these writers reached the intruder: " << line;
    }
  }
  EXPECT_EQ(domains, 5u) << heard.text;
  EXPECT_FALSE(run.skein().ended()) << "the run ended before the intruder did";
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  expect_whole(run);
  EXPECT_EQ(flight_of(run), alone(arguments("patrol", "300")));
}

INSTANTIATE_TEST_SUITE_P(Vendors, Intruder, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

}  // namespace
}  // namespace skein::test
