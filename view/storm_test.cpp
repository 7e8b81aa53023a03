// Many viewers, drawn at random, call the page's server: it serves those that it admits, and its use of the machine has
// bounds. A failure tells the seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <list>
#include <mutex>
#include <random>
#include <stop_token>
#include <thread>

#include "tests/support/eventually.hpp"
#include "view/testing/server_fixture.hpp"

namespace skein::view {
namespace {

using namespace std::chrono_literals;
using Random = std::mt19937;

/// Waits for this time, or until `over` requests the end.
void pass(const std::stop_token& over, std::chrono::milliseconds time) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any().wait_for(lock, over, time, [] { return false; });
}

auto one_of(const auto& choices, Random& random) { return choices[random() % choices.size()]; }

std::string noise(Random& random, std::size_t most) {
  std::string bytes(random() % (most + 1), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

/// A path that leads out of the folder of a server that serves one, in one of many spellings.
std::string traversal(Random& random) {
  const std::vector<std::string>
      ups = {"..",           "%2e%2e", "%2E.",         ".%2e", "%252e%252e",       "..%00",
             "%c0%ae%c0%ae", "....",   "%u002e%u002e", "..;",  "\xc0\xae\xc0\xae", "%e0%80%ae."},
      slashes = {"/", "\\", "%2f", "%5c", "//", "%252f", "/./", "%c0%af", "\xc0\xaf"},
      begins = {"/", "/live.js/", "/flight/", "//", "/.", "http://127.0.0.1/", "file://", ""},
      files = {"etc/passwd",       "proc/self/environ", "view.key",           "proc/self/cmdline",
               "etc/passwd%00.js", "etc/passwd?",       "etc/passwd#live.js", "live.js"};
  std::string path = one_of(begins, random);
  for (std::size_t i = 0, depth = 1 + random() % 8; i < depth; ++i)
    path += one_of(ups, random) + one_of(slashes, random);
  return path + one_of(files, random);
}

/// Replaces, removes or adds some bytes of a text.
std::string damaged(std::string text, Random& random) {
  for (std::size_t i = 0, times = 1 + random() % 6; i < times && !text.empty(); ++i) {
    const std::size_t at = random() % text.size();
    switch (random() % 4) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, random() % 20);
        break;
      case 2:
        text.insert(at, noise(random, 20));
        break;
      default:
        text.insert(at, text.substr(random() % text.size(), random() % 40));
    }
  }
  return text;
}

class Storm : public ServerTest {
 protected:
  ~Storm() override { stop_filling(); }

  /// Fills the feed as a flight does, from a thread of its own, with numbered lines and with states.
  void fill() {
    filler_ = std::jthread([this](const std::stop_token& full) {
      while (!full.stop_requested()) {
        feed_.add_line("\"line " + std::to_string(lines_++) + " " + std::string(200, 'x') + "\"");
        feed_.set_state("{\"n\":" + std::to_string(lines_) + "}");
        std::this_thread::yield();
        if (lines_ % 64 == 0) pass(full, 1ms);
      }
    });
  }
  void stop_filling() {
    filler_.request_stop();
    if (filler_.joinable()) filler_.join();
  }

  /// A request without a key, or with an incomplete one.
  std::string request(Random& random) const {
    const std::vector<std::string> targets = {"/", "/live.js", "/flight", "/enter", "*", "/?", "/flight?", "/LIVE.JS"},
                                   methods = {"GET", "POST", "HEAD", "PUT", "OPTIONS", "get", "PRI", "CONNECT", "G\tT"};
    const std::string key = Key::draw().text();
    const std::vector<std::string> lines = {own_host(),
                                            own_origin(),
                                            upgrade(),
                                            "Host: example.org\r\n",
                                            "Origin: http://example.org\r\n",
                                            "Origin: null\r\n",
                                            "Cookie: skein_" + std::to_string(listener_.port()) + "=" + key + "\r\n",
                                            "Cookie: " + noise(random, 60) + "\r\n",
                                            "Content-Length: " + std::to_string(random()) + "\r\n",
                                            "Content-Length: -1\r\n",
                                            "Content-Length: 4\r\n",
                                            "Transfer-Encoding: chunked\r\n",
                                            "Expect: 100-continue\r\n",
                                            "Connection: keep-alive\r\n",
                                            ": empty\r\n",
                                            "X-Long: " + std::string(random() % 20'000, 'x') + "\r\n",
                                            " folded: yes\r\n",
                                            noise(random, 80) + "\r\n"};
    std::string text = (random() % 4 == 0 ? one_of(methods, random) : "GET") + " " +
                       (random() % 3 == 0 ? traversal(random) : one_of(targets, random)) +
                       (random() % 8 == 0 ? " HTTP/9.9" : " HTTP/1.1") + "\r\n";
    if (random() % 4 != 0) text += own_host();
    for (std::size_t i = 0, count = random() % 5; i < count; ++i) text += one_of(lines, random);
    text += "\r\n";
    if (random() % 4 == 0) text += "key=" + key;
    if (random() % 8 == 0) text += noise(random, 3000);
    return random() % 3 == 0 ? damaged(text, random) : text;
  }

  /// Reads all lines of the feed so far and its newest state, which may come before the last line. Checks that
  /// none is missing.
  /// @returns the lines that it received
  std::string expect_all(Wire& browser) {
    feed_.set_state(R"({"n":"newest"})");
    const std::string last = "\"line " + std::to_string(lines_ - 1) + " ", newest = R"("state":{"n":"newest"})";
    test::Unframed unframed;
    std::size_t looked = 0;
    bool has_last = false, has_newest = false;
    browser.until([&](const std::string& heard) {
      const std::string& text = unframed.after(heard);
      const std::size_t from = looked - std::min<std::size_t>(looked, 100);
      has_last = has_last || text.find(last, from) != std::string::npos;
      has_newest = has_newest || text.find(newest, from) != std::string::npos;
      looked = text.size();
      return has_last && has_newest;
    });
    EXPECT_TRUE(has_newest);
    const std::string& text = unframed.after(browser.heard());
    std::size_t at = 0;
    for (std::size_t line = 0; line < lines_ && at != std::string::npos; ++line) {
      at = text.find("\"line " + std::to_string(line) + " ", at);
      EXPECT_NE(at, std::string::npos) << "line " << line << " of " << lines_ << " is missing";
    }
    return text;
  }
  /// Expects an answer without any data of the run, as viewers without a key must get it.
  static void expect_nothing_told(const std::string& answer, const std::string& to) {
    for (const char* secret : {"<p>the page</p>", "the_script()", "\"it\"", "root:", "HTTP/1.1 101", "Set-Cookie"}) {
      EXPECT_EQ(answer.find(secret), std::string::npos) << to << "\n" << answer;
    }
    if (answer.empty()) return;
    const std::string status = answer.substr(0, 13);
    EXPECT_TRUE(status == "HTTP/1.1 200 " || status.starts_with("HTTP/1.1 4") || status.starts_with("HTTP/1.0 4") ||
                status == "HTTP/1.0 200 ")
        << to << "\n"
        << answer;
  }

  std::atomic<std::size_t> lines_ = 0;

 private:
  std::jthread filler_;
};

/// The number of open descriptors of this process, which are those of the test and the server.
std::size_t open_descriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

class DrawnStorm : public Storm, public testing::WithParamInterface<unsigned> {};

// Malformed requests, requests without a key, and incomplete requests, while a browser follows the flight.
TEST_P(DrawnStorm, OfStrangersTellsThemNothingAndKeepsNoViewerOut) {
  Random random(GetParam());
  fill();
  const auto good = follower();
  const std::size_t before = open_descriptors();
  std::list<Wire> idle;  // they send a request or a part of one, and wait
  for (int i = 0; i < 450; ++i) {
    const std::string text = request(random);
    switch (random() % 3) {
      case 0: {
        idle.emplace_back(listener_.port()).send(text.substr(0, random() % text.size()));
        break;
      }
      case 1: {  // and closes the connection before the answer
        Wire(listener_.port()).send(text);
        break;
      }
      default: {
        Wire asks(listener_.port());
        asks.send(text);
        ::shutdown(asks.fd(), SHUT_WR);
        expect_nothing_told(asks.all(), text);
      }
    }
    if (i % 50 == 0) {
      EXPECT_NE(get("/", own_host() + cookie()).find("<p>the page</p>"), std::string::npos);
    }
  }
  EXPECT_LE(open_descriptors(), before + idle.size() + ServerLimits{}.visitors + 1)
      << "the server must keep few of the connections";
  EXPECT_NE(get("/live.js", own_host() + cookie()).find("the_script()"), std::string::npos);
  stop_filling();
  expect_all(*good);
  EXPECT_EQ(orders_, 0);
}

// These viewers have the key, and send orders and other texts.
TEST_P(DrawnStorm, OfFramesDoesNotKeepTheServerFromObeyingOrders) {
  Random random(GetParam());
  fill();
  const auto good = follower();
  const std::vector<std::string> payloads = {R"({"do":"step"})",
                                             R"({"do":"speed","to":"1e400"})",
                                             R"({"do":["step"]})",
                                             R"({"do":"step","do":"kill"})",
                                             std::string(900, '['),
                                             "null",
                                             "{}",
                                             "\xf0\x28\x8c\x28",
                                             R"({"do":"\ud800"})",
                                             std::string(70'000, 'x')};
  for (int i = 0; i < 60; ++i) {
    const auto wire = follower();
    std::string bytes;
    for (std::size_t frames = 1 + random() % 4; frames > 0; --frames) {
      bytes += frame(one_of(payloads, random), static_cast<unsigned char>(random() % 2 == 0 ? 0x81 : random()));
    }
    wire->send(damaged(bytes, random));
    if (random() % 2 == 0) wire->send(noise(random, 5000));
  }
  good->send(frame(R"({"do":"resume"})"));
  EXPECT_TRUE(eventually([&] { return last_ == TimeOrder::Kind::resume; }));
  stop_filling();
  expect_all(*good);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DrawnStorm, testing::Values(1U, 2U, 3U));

TEST_F(Storm, OfTraversalsFindsNoFile) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const std::string path = traversal(random);
    const std::string answer = get(path, own_host() + cookie());
    EXPECT_TRUE(answer.empty() || answer.starts_with("HTTP/1.1 404")) << path << "\n" << answer;
  }
}

// Any program on the host can open connections without a key.
TEST_F(Storm, OfConnectionsThatSayNothingKeepsNoViewerOut) {
  const auto good = follower();
  std::list<Wire> idle;
  for (int i = 0; i < 300; ++i) {
    idle.emplace_back(listener_.port());
    if (i % 2 == 0) idle.back().send("GET / HTTP/1.1\r\nHo");
  }
  EXPECT_NE(get("/", own_host() + cookie()).find("<p>the page</p>"), std::string::npos);
  const auto still_open = [&] { return std::ranges::count_if(idle, [](Wire& wire) { return !wire.is_closed(); }); };
  EXPECT_TRUE(eventually([&] { return still_open() <= static_cast<long>(ServerLimits{}.visitors); }));
  EXPECT_FALSE(idle.back().is_closed()) << "the server must close the oldest connections, not the newest";
  feed_.add_line(R"({"k":"late"})");
  EXPECT_NE(good->until([](const std::string& text) { return text.find("late") != std::string::npos; }).find("late"),
            std::string::npos);
}

TEST_F(Storm, OfSlowRequestsIsEnded) {
  serve({.request = 200ms});
  Wire drips(listener_.port());
  std::jthread drop([&](const std::stop_token& over) {
    while (!over.stop_requested()) {
      drips.send("x");
      pass(over, 5ms);
    }
  });
  EXPECT_TRUE(eventually([&] { return drips.is_closed(); })) << "a byte must not extend the time limit of a request";
}

TEST_F(Storm, OfBrowsersGetsAllLines) {
  fill();
  std::vector<std::unique_ptr<Wire>> browsers;
  for (int i = 0; i < 100; ++i) {
    browsers.push_back(std::make_unique<Wire>(listener_.port()));
    browsers.back()->send(follow());
  }
  EXPECT_TRUE(eventually([&] { return lines_ > 2000; }));
  stop_filling();
  for (const auto& browser : browsers) expect_all(*browser);
}

TEST_F(Storm, OfMoreBrowsersThanAreAllowedIsTurnedAway) {
  serve({.followers = 3});
  std::vector<std::unique_ptr<Wire>> browsers;
  for (int i = 0; i < 3; ++i) browsers.push_back(follower());
  Wire fourth(listener_.port());
  fourth.send(follow());
  fourth.until([](const std::string& text) { return text.size() > 12; });
  EXPECT_TRUE(fourth.heard().starts_with("HTTP/1.1 503")) << fourth.heard();
  browsers.pop_back();
  EXPECT_TRUE(eventually([&] {
    Wire next(listener_.port());
    next.send(follow());
    return next.until([](const std::string& text) { return text.size() > 12; }).starts_with("HTTP/1.1 101");
  })) << "a browser that leaves makes room for another";
}

// The browser's system buffers some data, and then accepts no more for a while.
TEST_F(Storm, ASlowReaderGetsAllLinesAndFewStates) {
  const auto slow = follower();
  constexpr int kStates = 20'000;
  for (int i = 0; i < kStates; ++i) {
    if (i % 10 == 0) feed_.add_line("\"line " + std::to_string(lines_++) + " " + std::string(1000, 'x') + "\"");
    feed_.set_state("{\"n\":" + std::to_string(i) + ",\"of\":\"" + std::string(5000, 'y') + "\"}");
  }
  const std::string heard = expect_all(*slow);
  std::size_t states = 0;
  for (std::size_t at = 0; (at = heard.find("\"state\":", at)) != std::string::npos; ++at) ++states;
  EXPECT_LT(states, kStates / 10U) << "whenever the reader was ready, it got only the newest state";
}

// The browser does not close the connection, as if its machine had lost power or network.
TEST_F(Storm, TheServerClosesTheConnectionOfASilentBrowser) {
  serve({.silence = 400ms});
  const auto dead = follower();
  EXPECT_TRUE(eventually([&] { return dead->is_closed(); }));
  const auto stuck = follower();  // a browser that reads nothing
  const std::size_t before = open_descriptors();
  for (int i = 0; i < 3000; ++i) feed_.add_line("\"" + std::string(5000, 'x') + "\"");
  EXPECT_TRUE(eventually([&] { return open_descriptors() < before; }));
}

}  // namespace
}  // namespace skein::view
