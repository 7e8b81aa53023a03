// Serves the page of a run to browsers: HTTP for the page, its script and the key's door, a WebSocket for what there is
// to be told (feed.hpp) and for what is asked of the run. What a browser wants to look at (look_order.hpp) is for its
// own connection, too.
//
// It has a thread of its own, so that nothing of the run ever waits for a browser. A connection is allowed little:
// short requests in short time, few connections at once, no file of the disk under any name. Who has not shown the key
// keeps nobody else out: when there are too many, the first of them go. A frame that is malformed or no order of ours
// ends its connection, and so does a silence: a browser that is there answers.
//   GET  /         the page, or the door for who has not shown the key
//   POST /enter    key=...: gives the cookie
//   GET  /live.js  the page's script    } with the cookie
//   GET  /flight   the WebSocket        } and from a page of ours
// Threads: constructor, stop() and destructor from one; `obey` is called from the server's own.
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

/// What is served under fixed names.
struct Site {
  std::string page;    ///< HTML
  std::string script;  ///< JavaScript
  /// By which browsers may ask for it, beside those of the listener's address (names_of()).
  std::vector<std::string> names = {};
};

/// What browsers are allowed; tests allow less.
struct ServerLimits {
  std::size_t visitors = 64;                  ///< requests at once
  std::size_t followers = 256;                ///< browsers that follow at once
  std::chrono::milliseconds request{10'000};  ///< in which a request must be there
  std::chrono::milliseconds silence{60'000};  ///< of a browser that takes nothing, or does not answer
};

class Server {
 public:
  using Obey = std::function<void(const Order&)>;

  /// @param listener  a listening socket, of which it takes a duplicate. @param feed  must outlive this.
  /// @throws std::system_error when the system has no thread or descriptor left.
  Server(int listener, Key key, Site site, Feed& feed, Obey obey = {}, const ServerLimits& limits = {});
  /// Tells browsers what is left to be told, for a second at most, and says goodbye.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Ends at once, as a process does that is killed: nothing more is told.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::view
