// Agents of a secured fleet, with their own user ids, try to use the page of their run.
#include <unistd.h>

#include <csignal>

#include "small_scene.hpp"
#include "tests/free_port.hpp"
#include "view_fixture.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

const std::string kAgent = "jurong";

// The requests that an agent tries; each printed line is a result. KEY is a key from any file that the agent can read.
// If the station does not serve the page yet, a connection waits until it does.
constexpr const char* kLooking = R"sh(
ask() {  # TARGET MORE BYTES
  exec 3<>/dev/tcp/127.0.0.1/$PORT || return
  printf 'GET %s HTTP/1.1\r\nHost: 127.0.0.1:%s\r\n%b\r\n' "$1" $PORT "$2" >&3
  timeout 20 cat <&3 | head -c $3 | tr -d '\r\0'
  exec 3>&-
}
verdict() { head -n 1 | tr -d '\n'; }
look() {
  for file in $(find "${TMPDIR:-/tmp}" -maxdepth 2 \( -name view.key -o -name view.html \) 2>/dev/null) $DOORS; do
    [ -r "$file" ] && KEY=$(grep -o '[0-9a-f]\{64\}' "$file" | head -n 1) && echo "reads $(basename "$file")"
  done
  # Only the owner knows what to search for. An agent has no key to compare with.
  [ -z "$SECRET" ] || for process in /proc/[0-9]*; do
    tr '\0' '\n' 2>/dev/null <$process/environ | grep -q "$SECRET" && echo "finds the key in an environment"
    tr '\0' '\n' 2>/dev/null <$process/cmdline | grep -q "$SECRET" && echo "finds the key on a command line"
  done
  cookie="Cookie: skein_$PORT=${KEY:-0}\r\n"
  page=$(ask / "$cookie" 100000)
  echo "$page" | grep -q 'The key, please' && echo "/: the door"
  echo "$page" | grep -q 'id="flight"' && echo "/: the page"
  echo "/live.js: $(ask /live.js "$cookie" 100 | verdict)"
  upgrade="Origin: http://127.0.0.1:$PORT\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
  echo "/flight: $(ask /flight "${cookie}${upgrade}Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" 100 | verdict)"
}
)sh";

class AgentsAndThePage : public ViewTest {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) GTEST_SKIP() << "agents have users of their own only when the launcher is root";
    ViewTest::SetUp();
  }
};

TEST_F(AgentsAndThePage, ASecuredAgentSeesOnlyTheLoginPage) {
  fs::permissions(folder(), fs::perms(0755));  // agents read the scenario as users of their own
  const std::string scenario = write_small_scene(folder() / "small");
  const FreePort port;
  const fs::path looking = write("looking.sh", "PORT=" + port.text() + "\n" + kLooking);
  const fs::path script = write("agent.sh", ". " + looking.string() +
                                                "\nlook >$SKEIN_OUT/looked 2>/dev/null\n"
                                                "id -u >>$SKEIN_OUT/looked\nexec " +
                                                helper_program("minimal_client") + "\n");
  SkeinRun& seen = start(
      "seen", {scenario, "--secure", "--duration", "20", "--no-oracle", "--no-report", "--planner",
               "hover," + kAgent + "=exec:exec /bin/bash " + script.string(), "--view", port.text(), "--speed", "2"});
  const fs::path door = door_of(seen);
  ASSERT_TRUE(seen.wait_until_flying()) << seen.err();

  // The same requests by the run's owner succeed.
  const std::string secret = text_of(door.parent_path() / "view.key").substr(0, 64);
  const fs::path own = write("own.sh", ". " + looking.string() + "\nSECRET=$(cat " + door.string() +
                                           " | grep -o '[0-9a-f]\\{64\\}')\nDOORS=" + door.string() + "\nlook\n");
  ChildProcess& user = start_program("user", {"/bin/bash", own});
  EXPECT_EQ(user.wait().code, 0) << user.err();
  const std::string by_user = user.out();
  for (const char* got : {"reads view.html", "/: the page", "/live.js: HTTP/1.1 200", "/flight: HTTP/1.1 101"}) {
    EXPECT_NE(by_user.find(got), std::string::npos) << got << " is not in\n" << by_user;
  }
  EXPECT_EQ(by_user.find("finds the key"), std::string::npos) << by_user;

  ASSERT_TRUE(seen.wait_for("replay")) << seen.err();
  seen.skein().signal(SIGINT);
  EXPECT_EQ(seen.exit_code(), 0) << seen.err();
  const std::string looked = text_of(seen.dir() / ("uav_agent-" + kAgent + ".looked"));
  const std::string refused = "/: the door\n/live.js: HTTP/1.1 403 Forbidden\n/flight: HTTP/1.1 403 Forbidden\n";
  ASSERT_TRUE(looked.starts_with(refused)) << looked;
  EXPECT_GT(std::atoi(looked.substr(refused.size()).c_str()), 0) << "the agent is root: " << looked;
  EXPECT_EQ(looked.find(secret), std::string::npos);
}

}  // namespace
}  // namespace skein::test
