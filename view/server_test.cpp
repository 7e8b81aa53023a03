// The page's server, with requests that the tests write: the files that it serves, and the clients that it refuses.
#include "view/server.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <random>

#include "core/types.hpp"
#include "tests/support/eventually.hpp"
#include "view/pages.hpp"
#include "view/testing/server_fixture.hpp"

namespace skein::view {
namespace {

TEST_F(ServerTest, ServesAViewerWithTheKey) {
  EXPECT_NE(get("/", own_host() + cookie()).find("<p>the page</p>"), std::string::npos);
  EXPECT_NE(get("/live.js", own_host() + cookie()).find("the_script()"), std::string::npos);
  EXPECT_NE(get("/", "Host: localhost:" + std::to_string(listener_.port()) + "\r\n" + cookie()).find("the page"),
            std::string::npos);
}

TEST_F(ServerTest, ShowsOthersThePageThatAsksForTheKey) {
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
  EXPECT_NE(entered.find("Set-Cookie: " + Door({}, key_).cookie(host())), std::string::npos) << entered;
  for (const std::string& body : {std::string(), std::string("key="), "key=" + Key::draw().text(), key_.text()}) {
    const std::string refused = enter(body);
    EXPECT_TRUE(refused.starts_with("HTTP/1.1 403")) << body << "\n" << refused;
    EXPECT_EQ(refused.find("Set-Cookie"), std::string::npos);
  }
  EXPECT_TRUE(get("/enter?key=" + key_.text(), own_host()).starts_with("HTTP/1.1 404"))
      << "the key must not be accepted in an address";
  EXPECT_TRUE(get("/enter", own_host()).starts_with("HTTP/1.1 403"));
}

TEST_F(ServerTest, RefusesOtherNamesOfThisHost) {
  const std::string port = std::to_string(listener_.port());
  const std::vector<std::string> others = {"example.org",
                                           "example.org:" + port,
                                           "192.0.2.7:" + port,
                                           "127.0.0.1.example.org",
                                           "localhost.example.org:80",
                                           "user@localhost:80",
                                           "127.1:80",
                                           "0x7f000001:80"};
  for (const std::string& name : others) {
    EXPECT_TRUE(get("/", "Host: " + name + "\r\n" + cookie()).starts_with("HTTP/1.1 421")) << name;
    EXPECT_TRUE(get("/flight", "Host: " + name + "\r\nOrigin: http://" + name + "\r\n" + cookie() + upgrade())
                    .starts_with("HTTP/1.1 421"))
        << name;
  }
  EXPECT_TRUE(get("/", cookie()).starts_with("HTTP/1.1 421")) << "the request has no Host line";
  EXPECT_TRUE(get("/", own_host() + own_host() + cookie()).starts_with("HTTP/1.1 421"))
      << "the request has two Host lines";
}

TEST_F(ServerTest, RefusesRequestsOfPagesFromElsewhere) {
  for (const std::string& origin :
       {std::string("http://example.org"), std::string("null"), "https://" + host(), std::string("http://127.0.0.1:1"),
        std::string("http://localhost"), "http://" + host() + ".example.org"}) {
    const std::string headers = own_host() + "Origin: " + origin + "\r\n" + cookie();
    for (const char* target : {"/", "/live.js"}) {
      EXPECT_TRUE(get(target, headers).starts_with("HTTP/1.1 403")) << target << " for " << origin;
    }
    EXPECT_TRUE(get("/flight", headers + upgrade()).starts_with("HTTP/1.1 403")) << origin;
  }
  EXPECT_FALSE(get("/flight", own_host() + cookie() + upgrade()).starts_with("HTTP/1.1 101"))
      << "a browser always sends the origin of its page";
}

TEST_F(ServerTest, ServesNoFilesUnderAnyName) {
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

TEST_F(ServerTest, ForbidsThePageToLoadAnythingFromElsewhere) {
  const std::string page = get("/", own_host() + cookie());
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'none';"), std::string::npos) << page;
  EXPECT_NE(page.find("X-Content-Type-Options: nosniff"), std::string::npos);
  EXPECT_NE(page.find("X-Frame-Options: DENY"), std::string::npos);
  EXPECT_EQ(page.find("Access-Control-Allow"), std::string::npos);
}

TEST_F(ServerTest, ClosesMalformedAndTooLongRequests) {
  for (const std::string& request :
       {std::string("nonsense\r\n\r\n"), std::string(64 << 10, 'x'),
        "GET / HTTP/1.1\r\nX: " + std::string(64 << 10, 'x'),
        "POST /enter HTTP/1.1\r\n" + own_host() + "Content-Length: 1000000\r\n\r\n" + std::string(64 << 10, 'x'),
        "POST /enter HTTP/1.1\r\n" + own_host() + "Transfer-Encoding: chunked\r\n\r\nffffffff\r\n"}) {
    EXPECT_EQ(ask(request), "") << request.substr(0, 40);
  }
  EXPECT_TRUE(get("/", own_host()).starts_with("HTTP/1.1 200")) << "the server still serves others";
}

TEST_F(ServerTest, SendsTheFlightToFollowersAndObeysTheirOrders) {
  const auto wire = follower();
  feed_.add_line(R"({"k":"late"})");
  wire->until([](const std::string& text) { return text.find("late") != std::string::npos; });
  wire->send(frame(R"({"do":"step"})"));
  EXPECT_TRUE(eventually([&] { return orders_ == 1; }));
  EXPECT_EQ(last_, TimeOrder::Kind::step);
  const auto other = follower();
  other->send(frame(R"({"do":"resume"})"));
  EXPECT_TRUE(eventually([&] { return orders_ == 2; })) << "orders of several browsers are obeyed";
}

TEST_F(ServerTest, SendsPointsAndMapsOnlyToViewersThatAskForThem) {
  const auto looks = follower(), other = follower();
  looks->send(frame(R"({"do":"look","lidar":["a"],"map":"b"})"));
  EXPECT_TRUE(eventually([&] { return orders_ == 1; })) << "the callback for orders gets this order, too";
  const auto has = [](const char* word) {
    return [word](const std::string& text) { return text.find(word) != std::string::npos; };
  };
  feed_.set_cloud("lidar a", R"({"its":"points"})");
  EXPECT_NE(looks->until(has("points")).find(R"("clouds":[{"its":"points"}])"), std::string::npos);
  feed_.set_cloud("lidar b", R"({"its":"others"})");
  feed_.set_cloud("map b", R"({"its":"map"})");
  EXPECT_EQ(looks->until(has("map")).find("others"), std::string::npos) << "the viewer did not ask for these maps";
  looks->send(frame(R"({"do":"look"})"));
  EXPECT_TRUE(eventually([&] { return orders_ == 2; }));
  feed_.set_cloud("map b", R"({"its":"later"})");
  for (const auto& wire : {looks.get(), other.get()}) {
    feed_.set_state(R"({"n":"newest"})");
    EXPECT_EQ(wire->until(has("newest")).find("later"), std::string::npos);
  }
  EXPECT_EQ(other->until(has("newest")).find("clouds"), std::string::npos);
}

TEST_F(ServerTest, ClosesConnectionsOfFollowersThatSendAnythingElse) {
  std::string unmasked = frame(R"({"do":"step"})");
  unmasked[1] = static_cast<char>(unmasked[1] & 0x7f);
  unmasked.erase(2, 4);
  for (const std::string& bytes :
       {frame("nonsense"), frame(R"({"do":"kill"})"), frame(R"({"do":"step"})", 0x82), frame(std::string(100'000, 'x')),
        unmasked, frame("x", 0x83), frame("x", 0xf1), frame(std::string(126, 'x'), 0x89),
        std::string("\x81\xff\xff", 3) + std::string(12, '\xff'), frame("\xff\xfe")}) {
    const auto wire = follower();
    wire->send(bytes);
    wire->all();  // returns when the server closes the connection
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

TEST_F(ServerTest, DoesNotWaitForAViewerThatDoesNotRead) {
  const auto slow = follower();
  slow->send(frame(R"({"do":"look","map":"a"})"));
  for (int i = 0; i < 20'000; ++i) {
    feed_.add_line("\"" + std::string(1000, 'x') + "\"");
    feed_.set_state("{\"n\":" + std::to_string(i) + "}");
    feed_.set_cloud("map a", "\"" + std::string(50'000, 'x') + "\"");
  }
  const auto quick = follower();
  feed_.set_state(R"({"n":"newest"})");
  EXPECT_NE(
      quick->until([](const std::string& text) { return text.find("newest") != std::string::npos; }).find("newest"),
      std::string::npos);
}

TEST_F(ServerTest, SendsTheRestAndACloseFrameAtItsEnd) {
  const auto wire = follower();
  feed_.add_line(R"({"k":"last"})");
  server_.reset();
  const std::string heard = wire->all();
  EXPECT_NE(heard.find("last"), std::string::npos);
  EXPECT_EQ(heard.substr(heard.size() - 4, 1), "\x88")
      << "the last frame closes the connection: two bytes, and a reason of two bytes";
}

TEST_F(ServerTest, LeavesNoConnectionWhenItIsStopped) {
  const auto wire = follower();
  server_->stop();
  wire->all();  // returns when the server closes the connection
  EXPECT_EQ(orders_, 0);
}

TEST_F(ServerTest, TheNextServerTakesOverAWaitingViewer) {
  server_->stop();
  Wire waiting(listener_.port());
  waiting.send("GET / HTTP/1.1\r\n" + own_host() + cookie() + "\r\n");
  server_.reset();
  const Server next(listener_.fd(), key_, Site{"<p>the replay</p>", ""}, feed_);
  EXPECT_NE(waiting.all().find("the replay"), std::string::npos);
}

// ssh -L 9000:127.0.0.1:8080: the browser knows only the near end of the tunnel.
TEST_F(ServerTest, ServesAViewerThatComesThroughATunnel) {
  for (const std::string near : {"localhost:9000", "127.0.0.1:9000", "[::1]:9000", "localhost"}) {
    const std::string headers = "Host: " + near + "\r\n", cookie = cookie_for(near);
    EXPECT_NE(get("/", headers).find("The key, please"), std::string::npos) << near;
    EXPECT_NE(get("/", headers + cookie).find("<p>the page</p>"), std::string::npos) << near;
    Wire wire(listener_.port());
    wire.send("GET /flight HTTP/1.1\r\n" + headers + "Origin: http://" + near + "\r\n" + cookie + upgrade() + "\r\n");
    EXPECT_NE(wire.until([](const std::string& text) { return text.find("\"it\"") != std::string::npos; }).find("101"),
              std::string::npos)
        << near;
    EXPECT_TRUE(get("/flight", headers + own_origin() + cookie + upgrade()).starts_with("HTTP/1.1 403"))
        << "a page at another port is from elsewhere";
    const std::string entered =
        ask("POST /enter HTTP/1.1\r\n" + headers + "Content-Length: 68\r\n\r\nkey=" + key_.text());
    EXPECT_NE(entered.find("Set-Cookie: " + Door({}, key_).cookie(near)), std::string::npos) << entered;
  }
}

TEST(Listeners, AreOnTheLoopbackAndOnFreePorts) {
  const Listener listener(0);
  EXPECT_EQ(listener.endpoint(), (Endpoint{"127.0.0.1", listener.port()}));
  EXPECT_EQ(endpoint_of(listener.fd()), listener.endpoint());
  EXPECT_THROW(Listener second(listener.port()), InputError) << "the port is in use";
  EXPECT_THROW(Listener elsewhere(Endpoint{"192.0.2.7", 0}), InputError) << "the address belongs to another host";
  EXPECT_THROW(endpoint_of(0), InputError);
  EXPECT_THROW(endpoint_of(-1), InputError);
}

TEST(Listeners, NameTheReasonIfThereIsNoSocket) {
  rlimit usual{};
  ::getrlimit(RLIMIT_NOFILE, &usual);
  const rlimit none{0, usual.rlim_max};
  std::string said;
  ::setrlimit(RLIMIT_NOFILE, &none);
  try {
    const Listener listener(0);
  } catch (const InputError& error) {
    said = error.what();
  }
  ::setrlimit(RLIMIT_NOFILE, &usual);
  EXPECT_NE(said.find("(Too many open files)"), std::string::npos) << said;
}

TEST(Listeners, ListenAtTheGivenAddress) {
  const Listener all(Endpoint{"0.0.0.0", 0});
  EXPECT_EQ(all.endpoint().address, "0.0.0.0");
  EXPECT_EQ(resolved("localhost:8080").port, 8080);
  EXPECT_TRUE(resolved("localhost:8080").is_loopback());
  EXPECT_EQ(resolved("127.0.0.2:1"), (Endpoint{"127.0.0.2", 1}));
  EXPECT_THROW(resolved("no.such.host.invalid:8080"), InputError);
  EXPECT_THROW(resolved("localhost:"), InputError);
}

// The names follow from the address at which the server listens, and from the names that it is given.
TEST(Servers, BeyondTheLoopbackKnowTheHostsNamesAndNoOthers) {
  const Listener all(Endpoint{"0.0.0.0", 0});
  Feed feed;
  const Server server(all.fd(), Key::draw(), Site{"<p>the page</p>", "", {"fly.example.org"}}, feed);
  const auto status_for = [&](const std::string& name) {
    Wire wire(all.port());
    wire.send("GET / HTTP/1.1\r\nHost: " + name + ":8080\r\n\r\n");
    return wire.all().substr(0, 12);
  };
  for (const std::string& name : names_of(all.endpoint())) {
    const bool is_v6 = name.find(':') != std::string::npos;
    EXPECT_EQ(status_for(is_v6 ? "[" + name + "]" : name), "HTTP/1.1 200") << name;
  }
  EXPECT_EQ(status_for("fly.example.org"), "HTTP/1.1 200");
  for (const char* name : {"example.org", "192.0.2.7", "0.0.0.0", "other.fly.example.org"}) {
    EXPECT_EQ(status_for(name), "HTTP/1.1 421") << name;
  }
}

TEST(KeyFilePages, PostTheKeyToThePage) {
  const Key key = Key::draw();
  const std::string page = key_file_page("127.0.0.1:8080", key);
  EXPECT_NE(page.find("action=\"http://127.0.0.1:8080/enter\""), std::string::npos);
  EXPECT_EQ(page.find("fetch"), std::string::npos) << "the page fetches only if it must wait for the server";
  EXPECT_NE(key_file_page("127.0.0.1:8080", key, true).find("fetch('http://127.0.0.1:8080/'"), std::string::npos);
  EXPECT_NE(page.find("value=\"" + key.text() + "\""), std::string::npos);
}

}  // namespace
}  // namespace skein::view
