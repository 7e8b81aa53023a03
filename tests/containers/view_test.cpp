// The page of a fleet in containers is served on this host, to browsers with the key, and UAVs cannot reach it.
#include <csignal>
#include <regex>

#include "container_fixture.hpp"
#include "tests/free_port.hpp"
#include "tests/support/places.hpp"
#include "tests/support/wire.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class PageInContainers : public Containers {
 protected:
  void SetUp() override {
    Containers::SetUp();
    if (!IsSkipped() && !fs::exists(source_path("build/web/live.js"))) {
      GTEST_SKIP() << "web/ is not built: ./skein test does that, or `npm ci && npm run build` there";
    }
  }

  std::string host() const { return "127.0.0.1:" + port_.text(); }
  /// Sends a request from this host. @returns the answer. @param key  empty: sends none.
  std::string get(const std::string& target, const std::string& key, const std::string& more = {}) const {
    Wire wire(static_cast<std::uint16_t>(std::stoi(port_.text())));
    wire.send("GET " + target + " HTTP/1.1\r\nHost: " + host() + "\r\n" +
              (key.empty() ? "" : "Cookie: skein_" + port_.text() + "=" + key + "\r\n") + more + "\r\n");
    return wire.until([](const std::string& text) { return text.find("\"scene\":") != std::string::npos; });
  }
  std::string follow(const std::string& key) const {
    return get("/flight", key, "Origin: http://" + host() + "\r\n" + kUpgrade);
  }
  /// All addresses of a container, and the addresses of its networks' gateways, whether these exist or not.
  static std::string addresses_of(const std::string& container) {
    return shell("docker inspect --format '{{range .NetworkSettings.Networks}}{{.IPAddress}} {{.Gateway}} {{end}}' " +
                 container)
        .text;
  }
  static std::string gateways_of(const std::string& project) {
    return shell("docker network ls --quiet --filter label=com.docker.compose.project=" + project +
                 " | xargs docker network inspect --format '{{range .IPAM.Config}}{{.Gateway}} {{end}}'")
        .text;
  }

  const FreePort port_;
};

// Prints each address and port that it can reach.
constexpr const char* kKnocking = R"sh(
for address in $ADDRESSES; do
  for port in $PORTS; do
    if timeout 3 bash -c "exec 3<>/dev/tcp/$address/$port" 2>/dev/null; then echo "reaches $address:$port"; fi &
  done
done
wait
getent hosts page.view && echo "resolves page.view"
true
)sh";

TEST_F(PageInContainers, IsServedOnThisHostAndReachedByNoUav) {
  const Arguments flight = arguments("patrol", "120");
  SkeinRun& run = start_up("up", joined(flight, {"--view", port_.text(), "--speed", "4"}));
  const std::string uav = flying(run, "uav_agent-jurong"), station = container(run, "station");
  std::smatch door;
  const std::string said = run.err();
  ASSERT_TRUE(std::regex_search(said, door, std::regex("open (\\S+)"))) << said;
  const std::string key = text_of(fs::path(door[1].str()).parent_path() / "view.key").substr(0, 64);

  EXPECT_NE(get("/", "").find("The key, please"), std::string::npos);
  EXPECT_TRUE(follow("").starts_with("HTTP/1.1 403"));
  EXPECT_NE(get("/", key).find("id=\"flight\""), std::string::npos);
  EXPECT_TRUE(follow(key).starts_with("HTTP/1.1 101"));

  const std::string inspected = shell("docker inspect " + station).text;
  EXPECT_EQ(inspected.find(key), std::string::npos) << "a command line or an environment contains the key";
  EXPECT_EQ(text_of(run.dir() / "compose.yaml").find(key), std::string::npos);

  const std::string addresses = addresses_of(station) + " " + gateways_of(project(run)) + " " +
                                shell("hostname --all-ip-addresses").text + " 127.0.0.1";
  EXPECT_GE(words(addresses).size(), 3u + 8u + 1u) << addresses;
  std::string listed;
  for (const std::string& address : words(addresses)) {
    if (address.find(':') == std::string::npos) listed += " " + address;
  }
  const fs::path script =
      write("knocking.sh", "ADDRESSES='" + listed + "'\nPORTS='8080 " + port_.text() + "'\n" + kKnocking);
  EXPECT_EQ(shell("docker exec --interactive " + uav + " bash -s < " + script.string()).text, "");
  const std::string by_host = shell("bash " + script.string()).text,
                    by_station = shell("docker exec --interactive " + station + " bash -s < " + script.string()).text;
  EXPECT_NE(by_host.find("reaches 127.0.0.1:" + port_.text()), std::string::npos)
      << "not even this host reaches the page: " << by_host;
  EXPECT_NE(by_station.find(":8080"), std::string::npos) << by_station;
  EXPECT_NE(by_station.find("page.view"), std::string::npos) << by_station;
  EXPECT_EQ(by_station.find("reaches 127.0.0.1:8080"), std::string::npos) << "the page is also served on the loopback";

  ASSERT_TRUE(run.wait_for("the page shows the replay")) << run.err();
  EXPECT_TRUE(eventually([&] { return follow(key).starts_with("HTTP/1.1 101"); }))
      << "the launcher does not serve the replay";
  run.skein().signal(SIGINT);
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  EXPECT_EQ(flight_of(run), alone(flight));
}

}  // namespace
}  // namespace skein::test
