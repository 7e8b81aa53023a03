// The page's server, by hand-made requests: what it serves, and whom it refuses.
#include "view/server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <random>

#include "core/types.hpp"
#include "tests/support/eventually.hpp"
#include "view/listener.hpp"
#include "view/pages.hpp"

namespace skein::view {
namespace {

/// A connection to a server on this host, which speaks bytes.
class Wire {
 public:
  explicit Wire(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Wire() { ::close(fd_); }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  void send(const std::string& bytes) const { ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
  /// Until the server closes the connection.
  std::string all() {
    return until([](const std::string&) { return false; });
  }
  /// Until it has said enough, or closes.
  template <class Enough>
  std::string until(const Enough& enough) {
    char buffer[4096];
    while (!enough(heard_)) {
      const ssize_t size = ::recv(fd_, buffer, sizeof buffer, 0);
      if (size <= 0) break;
      heard_.append(buffer, static_cast<std::size_t>(size));
    }
    return heard_;
  }

 private:
  int fd_;
  std::string heard_;
};

/// A masked frame, as a browser sends it. @param first  its first byte: 0x81 is a text
std::string frame(const std::string& payload, unsigned char first = 0x81) {
  std::string bytes{static_cast<char>(first)};
  if (payload.size() < 126) {
    bytes += static_cast<char>(0x80 | payload.size());
  } else {
    bytes += static_cast<char>(0x80 | 126);
    bytes += static_cast<char>(payload.size() >> 8);
    bytes += static_cast<char>(payload.size() & 0xff);
  }
  return bytes + std::string(4, '\0') + payload;
}

class ServerTest : public testing::Test {
 protected:
  ServerTest() {
    feed_.set_scene(R"({"scene":"it"})");
    server_ = std::make_unique<Server>(listener_.fd(), key_, Site{"<p>the page</p>", "the_script()"}, feed_,
                                       [this](const TimeOrder& order) {
                                         last_ = order.kind;
                                         ++orders_;
                                       });
  }

  std::string host() const { return "127.0.0.1:" + std::to_string(listener_.port()); }
  std::string cookie() const {
    const std::string text = Door(listener_.port(), key_).cookie();
    return "Cookie: " + text.substr(0, text.find(';')) + "\r\n";
  }
  /// @param headers  each with its line's end
  std::string get(const std::string& target, const std::string& headers) const {
    return ask("GET " + target + " HTTP/1.1\r\n" + headers + "\r\n");
  }
  std::string ask(const std::string& request) const {
    Wire wire(listener_.port());
    wire.send(request);
    return wire.all();
  }
  std::string own_host() const { return "Host: " + host() + "\r\n"; }
  std::string upgrade() const {
    return "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  }
  std::string own_origin() const { return "Origin: http://" + host() + "\r\n"; }
  /// A browser that follows, and has been told the scene.
  std::unique_ptr<Wire> follower() const {
    auto wire = std::make_unique<Wire>(listener_.port());
    wire->send("GET /flight HTTP/1.1\r\n" + own_host() + own_origin() + cookie() + upgrade() + "\r\n");
    const std::string heard =
        wire->until([](const std::string& text) { return text.find("\"it\"") != std::string::npos; });
    EXPECT_TRUE(heard.starts_with("HTTP/1.1 101")) << heard;
    return wire;
  }

  const Listener listener_{0};
  const Key key_ = Key::draw();
  Feed feed_;
  std::atomic<int> orders_ = 0;
  std::atomic<TimeOrder::Kind> last_ = TimeOrder::Kind::pause;
  std::unique_ptr<Server> server_;
};

TEST_F(ServerTest, ServesWhoHasTheKey) {
  EXPECT_NE(get("/", own_host() + cookie()).find("<p>the page</p>"), std::string::npos);
  EXPECT_NE(get("/live.js", own_host() + cookie()).find("the_script()"), std::string::npos);
  EXPECT_NE(get("/", "Host: localhost:" + std::to_string(listener_.port()) + "\r\n" + cookie()).find("the page"),
            std::string::npos);
}

TEST_F(ServerTest, ShowsTheDoorToOthers) {
  const std::string page = get("/", own_host());
  EXPECT_NE(page.find("The key, please"), std::string::npos);
  EXPECT_EQ(page.find("the page</p>"), std::string::npos);
  EXPECT_EQ(page.find(key_.text()), std::string::npos);
  const std::string wrong = "Cookie: skein_" + std::to_string(listener_.port()) + "=" + Key::draw().text() + "\r\n";
  EXPECT_NE(get("/", own_host() + wrong).find("The key, please"), std::string::npos);
  EXPECT_TRUE(get("/live.js", own_host() + wrong).starts_with("HTTP/1.1 403"));
  EXPECT_TRUE(get("/flight", own_host() + wrong + own_origin() + upgrade()).starts_with("HTTP/1.1 403"));
}

TEST_F(ServerTest, GivesTheCookieForTheKey) {
  const auto enter = [this](const std::string& body) {
    return ask("POST /enter HTTP/1.1\r\n" + own_host() +
               "Origin: null\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  };
  const std::string entered = enter("key=" + key_.text());
  EXPECT_TRUE(entered.starts_with("HTTP/1.1 200")) << entered;
  EXPECT_NE(entered.find("Set-Cookie: " + Door(listener_.port(), key_).cookie()), std::string::npos) << entered;
  for (const std::string& body : {std::string(), std::string("key="), "key=" + Key::draw().text(), key_.text()}) {
    const std::string refused = enter(body);
    EXPECT_TRUE(refused.starts_with("HTTP/1.1 403")) << body << "\n" << refused;
    EXPECT_EQ(refused.find("Set-Cookie"), std::string::npos);
  }
  EXPECT_TRUE(get("/enter?key=" + key_.text(), own_host()).starts_with("HTTP/1.1 404")) << "never in an address";
  EXPECT_TRUE(get("/enter", own_host()).starts_with("HTTP/1.1 403"));
}

TEST_F(ServerTest, RefusesOtherNamesOfThisHost) {
  for (const std::string& name : {std::string("example.org"), "example.org:" + std::to_string(listener_.port()),
                                  std::string("127.0.0.1"), std::string("127.0.0.1:1")}) {
    EXPECT_TRUE(get("/", "Host: " + name + "\r\n" + cookie()).starts_with("HTTP/1.1 421")) << name;
    EXPECT_TRUE(get("/flight", "Host: " + name + "\r\nOrigin: http://" + name + "\r\n" + cookie() + upgrade())
                    .starts_with("HTTP/1.1 421"))
        << name;
  }
  EXPECT_TRUE(get("/", cookie()).starts_with("HTTP/1.1 421")) << "none at all";
  EXPECT_TRUE(get("/", own_host() + own_host() + cookie()).starts_with("HTTP/1.1 421")) << "two";
}

TEST_F(ServerTest, RefusesPagesOfElsewhere) {
  for (const std::string& origin : {std::string("http://example.org"), std::string("null"), "https://" + host(),
                                    std::string("http://127.0.0.1:1"), "http://" + host() + ".example.org"}) {
    const std::string headers = own_host() + "Origin: " + origin + "\r\n" + cookie();
    for (const char* target : {"/", "/live.js"}) {
      EXPECT_TRUE(get(target, headers).starts_with("HTTP/1.1 403")) << target << " for " << origin;
    }
    EXPECT_TRUE(get("/flight", headers + upgrade()).starts_with("HTTP/1.1 403")) << origin;
  }
  EXPECT_FALSE(get("/flight", own_host() + cookie() + upgrade()).starts_with("HTTP/1.1 101"))
      << "a browser says where its page is from";
}

TEST_F(ServerTest, HasNoFilesUnderAnyName) {
  for (const char* target :
       {"/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/live.js/../../etc/passwd", "//etc/passwd", "/..%5c..%5cetc",
        "/index.html", "/view.key", "/live.js?x", "/live.js%00", "/result.json"}) {
    const std::string answer = get(target, own_host() + cookie());
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 404")) << target << "\n" << answer;
    EXPECT_EQ(answer.find("root:"), std::string::npos) << target;
  }
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT"}) {
    EXPECT_TRUE(ask(std::string(method) + " / HTTP/1.1\r\n" + own_host() + cookie() + "Content-Length: 0\r\n\r\n")
                    .starts_with("HTTP/1.1 405"))
        << method;
  }
}

TEST_F(ServerTest, SaysThatNothingMayBeFetchedFromElsewhere) {
  const std::string page = get("/", own_host() + cookie());
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'none';"), std::string::npos) << page;
  EXPECT_NE(page.find("X-Content-Type-Options: nosniff"), std::string::npos);
  EXPECT_NE(page.find("X-Frame-Options: DENY"), std::string::npos);
  EXPECT_EQ(page.find("Access-Control-Allow"), std::string::npos);
}

TEST_F(ServerTest, EndsWhatIsMalformedOrTooLong) {
  for (const std::string& request :
       {std::string("nonsense\r\n\r\n"), std::string(64 << 10, 'x'),
        "GET / HTTP/1.1\r\nX: " + std::string(64 << 10, 'x'),
        "POST /enter HTTP/1.1\r\n" + own_host() + "Content-Length: 1000000\r\n\r\n" + std::string(64 << 10, 'x'),
        "POST /enter HTTP/1.1\r\n" + own_host() + "Transfer-Encoding: chunked\r\n\r\nffffffff\r\n"}) {
    EXPECT_EQ(ask(request), "") << request.substr(0, 40);
  }
  EXPECT_TRUE(get("/", own_host()).starts_with("HTTP/1.1 200")) << "it still serves";
}

TEST_F(ServerTest, TellsFollowersAndObeysThem) {
  const auto wire = follower();
  feed_.add_line(R"({"k":"late"})");
  wire->until([](const std::string& text) { return text.find("late") != std::string::npos; });
  wire->send(frame(R"({"do":"step"})"));
  EXPECT_TRUE(eventually([&] { return orders_ == 1; }));
  EXPECT_EQ(last_, TimeOrder::Kind::step);
  const auto other = follower();
  other->send(frame(R"({"do":"resume"})"));
  EXPECT_TRUE(eventually([&] { return orders_ == 2; })) << "several browsers follow";
}

TEST_F(ServerTest, EndsFollowersThatSendAnythingElse) {
  std::string unmasked = frame(R"({"do":"step"})");
  unmasked[1] = static_cast<char>(unmasked[1] & 0x7f);
  unmasked.erase(2, 4);
  for (const std::string& bytes :
       {frame("nonsense"), frame(R"({"do":"kill"})"), frame(R"({"do":"step"})", 0x82), frame(std::string(2000, 'x')),
        unmasked, frame("x", 0x83), frame("x", 0xf1), frame(std::string(126, 'x'), 0x89),
        std::string("\x81\xff\xff", 3) + std::string(12, '\xff'), frame("\xff\xfe")}) {
    const auto wire = follower();
    wire->send(bytes);
    wire->all();  // comes to its end
  }
  EXPECT_EQ(orders_, 0);
}

TEST_F(ServerTest, SurvivesNoise) {
  std::mt19937 draw(7);
  for (int i = 0; i < 200; ++i) {
    std::string bytes(1 + draw() % 300, '\0');
    for (char& byte : bytes) byte = static_cast<char>(draw());
    if (i % 2 == 0) {
      const auto wire = follower();
      wire->send(bytes);
    } else {
      Wire wire(listener_.port());
      wire.send(bytes);
    }
  }
  EXPECT_EQ(orders_, 0);
  EXPECT_TRUE(get("/", own_host()).starts_with("HTTP/1.1 200"));
}

TEST_F(ServerTest, DoesNotWaitForWhoDoesNotRead) {
  const auto slow = follower();
  for (int i = 0; i < 20'000; ++i) {
    feed_.add_line("\"" + std::string(1000, 'x') + "\"");
    feed_.set_state("{\"n\":" + std::to_string(i) + "}");
  }
  const auto quick = follower();
  feed_.set_state(R"({"n":"newest"})");
  EXPECT_NE(
      quick->until([](const std::string& text) { return text.find("newest") != std::string::npos; }).find("newest"),
      std::string::npos);
}

TEST_F(ServerTest, SaysGoodbyeWithWhatIsLeft) {
  const auto wire = follower();
  feed_.add_line(R"({"k":"last"})");
  server_.reset();
  const std::string heard = wire->all();
  EXPECT_NE(heard.find("last"), std::string::npos);
  EXPECT_EQ(heard.substr(heard.size() - 4, 1), "\x88") << "a frame that closes it: two bytes, and why";
}

TEST_F(ServerTest, LeavesNoConnectionWhenItIsStopped) {
  const auto wire = follower();
  server_->stop();
  wire->all();  // comes to its end
  EXPECT_EQ(orders_, 0);
}

TEST_F(ServerTest, AnotherOneTakesOverWhoWaits) {
  server_->stop();
  Wire waiting(listener_.port());
  waiting.send("GET / HTTP/1.1\r\n" + own_host() + cookie() + "\r\n");
  server_.reset();
  const Server next(listener_.fd(), key_, Site{"<p>the replay</p>", ""}, feed_);
  EXPECT_NE(waiting.all().find("the replay"), std::string::npos);
}

TEST(Listeners, AreOnTheLoopbackAndOnFreePorts) {
  const Listener listener(0);
  EXPECT_EQ(port_of(listener.fd()), listener.port());
  EXPECT_THROW(Listener second(listener.port()), InputError) << "taken";
  EXPECT_THROW(port_of(0), InputError);
  EXPECT_THROW(port_of(-1), InputError);
}

TEST(KeyFilePages, ShowTheKeyToThePageAlone) {
  const Key key = Key::draw();
  const std::string page = key_file_page(8080, key);
  EXPECT_NE(page.find("action=\"http://127.0.0.1:8080/enter\""), std::string::npos);
  EXPECT_NE(page.find("value=\"" + key.text() + "\""), std::string::npos);
}

}  // namespace
}  // namespace skein::view
