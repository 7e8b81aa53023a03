// For tests: a page's server, and hand-made requests to it.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <memory>

#include "tests/support/wire.hpp"
#include "view/listener.hpp"
#include "view/server.hpp"

namespace skein::view {

using test::frame;
using test::Wire;

class ServerTest : public testing::Test {
 protected:
  ServerTest() {
    feed_.set_scene(R"({"scene":"it"})");
    serve({});
  }

  /// Replaces the server with a new one with these limits.
  void serve(const ServerLimits& limits) {
    server_.reset();
    server_ = std::make_unique<Server>(
        listener_.fd(), key_, Site{"<p>the page</p>", "the_script()"}, feed_,
        [this](const Order& order) {
          if (const auto* time = std::get_if<TimeOrder>(&order)) last_ = time->kind;
          ++orders_;
        },
        limits);
  }

  std::string host() const { return "127.0.0.1:" + std::to_string(listener_.port()); }
  std::string cookie() const { return cookie_for(host()); }
  std::string cookie_for(const std::string& name) const {
    const std::string text = Door({}, key_).cookie(name);
    return "Cookie: " + text.substr(0, text.find(';')) + "\r\n";
  }
  /// The answer to a GET request. @param headers  lines with their line ends
  std::string get(const std::string& target, const std::string& headers) const {
    return ask("GET " + target + " HTTP/1.1\r\n" + headers + "\r\n");
  }
  std::string ask(const std::string& request) const {
    Wire wire(listener_.port());
    wire.send(request);
    return wire.all();
  }
  std::string own_host() const { return "Host: " + host() + "\r\n"; }
  static std::string upgrade() { return test::kUpgrade; }
  std::string own_origin() const { return "Origin: http://" + host() + "\r\n"; }
  /// The request that opens the WebSocket of the flight.
  std::string follow() const {
    return "GET /flight HTTP/1.1\r\n" + own_host() + own_origin() + cookie() + upgrade() + "\r\n";
  }
  /// A browser whose WebSocket is open and that has received the scene.
  std::unique_ptr<Wire> follower() const {
    auto wire = std::make_unique<Wire>(listener_.port());
    wire->send(follow());
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

}  // namespace skein::view
