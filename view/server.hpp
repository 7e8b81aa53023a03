// Serves the page of a run to browsers: HTTP for the page, its script and the login page; a WebSocket for the feed
// (feed.hpp) and for the browser's orders. A LookOrder (look_order.hpp) also sets which clouds its connection gets.
//
// The server has its own thread, so the run never waits for a browser. It limits each connection: the size and duration
// of a request, and the number of connections at once; it serves no files from disk. Visitors without the key cannot
// lock out others: when there are too many, the server drops the one of them that came first. It closes a connection
// that sends a malformed frame or anything but an order, and one that is silent: a live browser answers its pings.
//   GET  /         the page, or the login page for a browser that has not presented the key
//   POST /enter    key=...: sets the cookie
//   GET  /live.js  the page's script    } only with the cookie,
//   GET  /flight   the WebSocket        } and from this server's own page
// Threads: constructor, stop() and destructor from one; `obey` is called in the server's own thread.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "view/door.hpp"
#include "view/feed.hpp"
#include "view/order.hpp"

namespace skein::view {

/// The content that the server serves.
struct Site {
  std::string page;    ///< HTML
  std::string script;  ///< JavaScript
  /// Host names that browsers may use, besides those of the listener's address (names_of()).
  std::vector<std::string> names = {};
};

/// Limits for browsers; tests use smaller ones.
struct ServerLimits {
  std::size_t visitors = 64;                  ///< HTTP requests at once
  std::size_t followers = 256;                ///< WebSocket connections at once
  std::chrono::milliseconds request{10'000};  ///< timeout for the arrival of a complete request
  std::chrono::milliseconds silence{60'000};  ///< timeout for a browser that reads nothing, or does not answer pings
};

class Server {
 public:
  using Obey = std::function<void(const Order&)>;

  /// @param listener  descriptor of a listening socket; the server uses a duplicate. @param feed  must outlive this.
  /// @param obey  called with each order of a browser.
  /// @throws InputError when `listener` is not such a socket; std::system_error when the operating system has no thread
  /// or descriptor left.
  Server(int listener, Key key, Site site, Feed& feed, Obey obey = {}, const ServerLimits& limits = {});
  /// Sends the browsers the rest of the feed, for a second at most, and closes their connections properly.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Closes all connections at once, as if the process were killed: sends nothing more.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::view
