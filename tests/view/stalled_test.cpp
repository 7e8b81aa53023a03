// Browsers that stop reading, and clients without the key, while a fleet flies.
#include <csignal>
#include <fstream>
#include <list>

#include "tests/free_port.hpp"
#include "tests/support/wire.hpp"
#include "view_fixture.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class StalledBrowsers : public ViewTest {
 protected:
  std::string host() const { return "127.0.0.1:" + port_.text(); }
  std::uint16_t port() const { return static_cast<std::uint16_t>(std::stoi(port_.text())); }
  /// The request to follow a run. @param key  the run's key
  std::string follow(const std::string& key) const {
    return "GET /flight HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: http://" + host() + "\r\nCookie: skein_" +
           port_.text() + "=" + key + "\r\n" + kUpgrade + "\r\n";
  }
  static std::string key_beside(const fs::path& door) {
    std::ifstream in(door.parent_path() / "view.key");
    std::string key;
    in >> key;
    return key;
  }

  const FreePort port_;
};

TEST_F(StalledBrowsers, NeitherDelayTheRunNorChangeIt) {
  const Arguments flight = {"towers", "--planner", "kios", "--duration", "30", "--no-oracle", "--no-report"};
  const std::string unseen = run("unseen", joined(flight, {"--one-process"})).digest();
  for (const Arguments& how : {Arguments{"--one-process"}, Arguments{}}) {
    SkeinRun& seen = start(how.empty() ? "dds" : "one",
                           joined(joined(flight, how), {"--view", port_.text(), "--view-close", "--speed", "max"}));
    const std::string key = key_beside(door_of(seen));
    std::list<Wire> stalled;
    for (int i = 0; i < 40; ++i) {  // the station accepts these clients, which then stop reading
      stalled.emplace_back(port()).send(follow(key));
      stalled.back().until([](const std::string& text) { return text.find("101") != std::string::npos; });
    }
    for (int i = 0; i < 100; ++i) stalled.emplace_back(port()).send("GET / HTTP/1.1\r\nHost: ");
    EXPECT_EQ(seen.exit_code(), 0) << seen.err();
    EXPECT_EQ(seen.digest(), unseen);
    expect_complete_result(seen);
  }
}

}  // namespace
}  // namespace skein::test
