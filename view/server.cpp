#include "view/server.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "view/listener.hpp"
#include "view/pages.hpp"

namespace skein::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::use_awaitable;
using asio::ip::tcp;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;
using WebSocket = websocket::stream<beast::tcp_stream>;
using namespace std::chrono_literals;

constexpr std::size_t kMostHeader = 8 << 10, kMostBody = 1 << 10, kMostMessage = kLongestLook;
constexpr std::size_t kBatch = 128 << 10;
/// The operating system's send buffer for a browser; it is small, because states that wait in it become outdated.
constexpr int kSendBuffer = 128 << 10;
/// Pause between two messages to a browser, which shows about ten frames per second.
constexpr auto kPause = 80ms;
constexpr auto kGoodbye = 1s;

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

/// A connection with an HTTP request.
struct Visitor {
  explicit Visitor(tcp::socket&& socket) : stream(std::move(socket)) {}

  beast::tcp_stream stream;
  bool has_key = false;
};

/// A browser that follows the flight over a WebSocket.
struct Follower {
  explicit Follower(beast::tcp_stream&& stream)
      : socket(std::move(stream)), news(socket.get_executor()), pause(socket.get_executor()) {
    news.expires_at(asio::steady_timer::time_point::max());
  }

  WebSocket socket;
  asio::steady_timer news;   ///< cancelled when there is news
  asio::steady_timer pause;  ///< between two messages
  FeedPlace place;
  std::chrono::steady_clock::time_point looks_until{};  ///< when its request for clouds expires
  bool closing = false;
};

}  // namespace

struct Server::Impl {
  Impl(int listener, Key key, Site the_site, Feed& the_feed, Obey the_obey, const ServerLimits& the_limits)
      : door(all_names(listener, the_site), std::move(key)),
        site(std::move(the_site)),
        feed(the_feed),
        obey(std::move(the_obey)),
        limits(the_limits),
        acceptor(io) {
    const int own = ::dup(listener);
    if (own < 0) throw std::system_error(errno, std::generic_category(), "the socket of the page");
    acceptor.assign(endpoint_of(listener).address.find(':') == std::string::npos ? tcp::v4() : tcp::v6(), own);
    asio::co_spawn(io, accept(), asio::detached);
    // The server's thread blocks all signals: the main thread handles them.
    sigset_t all, former;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &former);
    thread = std::thread([this] { run(); });
    ::pthread_sigmask(SIG_SETMASK, &former, nullptr);
    feed.on_news([this] {
      if (!told.exchange(true)) asio::post(io, [this] { tell_news(); });
    });
  }

  ~Impl() { end(kGoodbye); }

  static std::vector<std::string> all_names(int listener, const Site& site) {
    std::vector<std::string> names = names_of(endpoint_of(listener));
    names.insert(names.end(), site.names.begin(), site.names.end());
    return names;
  }

  /// @param patience  how long browsers may take to receive the rest of the feed.
  void end(std::chrono::milliseconds patience) {
    feed.on_news({});
    if (!thread.joinable()) return;
    asio::post(io, [this, patience] { say_goodbye(patience); });
    thread.join();
  }

  void run() {
    // A request that fails in an unforeseen way must not end the run.
    while (true) {
      try {
        io.run();
        return;
      } catch (const std::exception& error) {
        spdlog::warn("the page: {}", error.what());
      }
    }
  }

  /// Lets the follower get the rest of the feed, and then close.
  static void leave(Follower& follower) {
    follower.closing = true;
    follower.news.cancel();
    follower.pause.cancel();
  }

  void tell_news() {
    told = false;
    for (const auto& follower : followers) follower->news.cancel();
  }

  void say_goodbye(std::chrono::milliseconds patience) {
    // release(), not close(): the duplicate must leave the poll set while the launcher keeps the socket open.
    boost::system::error_code ignored;
    if (acceptor.is_open()) ::close(acceptor.release(ignored));
    closing = true;
    for (const auto& follower : followers) leave(*follower);
    if (patience == 0ms || at_work == 0) return io.stop();
    last_call.expires_after(patience);
    last_call.async_wait([this](boost::system::error_code) { io.stop(); });
  }

  asio::awaitable<void> accept() {
    while (acceptor.is_open()) {
      boost::system::error_code error;
      tcp::socket socket = co_await acceptor.async_accept(asio::redirect_error(use_awaitable, error));
      if (closing || error == asio::error::operation_aborted) co_return;
      if (error) {  // for example, no descriptor is left: one may become free
        asio::steady_timer later(io, 100ms);
        co_await later.async_wait(use_awaitable);
        continue;
      }
      if (visitors.size() >= limits.visitors && !make_room()) continue;  // closes the new socket
      const auto visitor = std::make_shared<Visitor>(std::move(socket));
      visitors.push_back(visitor);
      spawn(serve(visitor), [this, visitor] { std::erase(visitors, visitor); });
    }
  }

  /// Closes the oldest connection without the key, because any program that reaches the port may connect and send
  /// nothing. @returns false when there is none.
  bool make_room() {
    const auto stranger = std::ranges::find(visitors, false, [](const auto& visitor) { return visitor->has_key; });
    if (stranger == visitors.end()) return false;
    (*stranger)->stream.close();
    visitors.erase(stranger);
    return true;
  }

  /// Starts a coroutine. @param last  called when the coroutine ends, also by an exception.
  void spawn(asio::awaitable<void> work, const auto& last) {
    ++at_work;
    asio::co_spawn(io, std::move(work), [this, last](const std::exception_ptr&) {
      last();
      if (--at_work == 0 && closing) io.stop();
    });
  }

  asio::awaitable<void> serve(std::shared_ptr<Visitor> visitor) {
    beast::tcp_stream& stream = visitor->stream;
    beast::flat_buffer buffer(kMostHeader + kMostBody);
    http::request_parser<http::string_body> parser;
    parser.header_limit(kMostHeader);
    parser.body_limit(kMostBody);
    stream.expires_after(limits.request);
    co_await http::async_read(stream, buffer, parser, use_awaitable);
    const Request request = parser.release();
    visitor->has_key = knows(request) && has_key(request);
    if (websocket::is_upgrade(request) && may_follow(request)) {
      const auto follower = std::make_shared<Follower>(std::move(stream));
      std::erase(visitors, visitor);
      followers.push_back(follower);
      spawn(follow(follower, request), [this, follower] { std::erase(followers, follower); });
      co_return;
    }
    Response response = answer(request);
    stream.expires_after(limits.silence);
    co_await http::async_write(stream, response, use_awaitable);
    boost::system::error_code ignored;
    stream.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  bool may_follow(const Request& request) const {
    return request.target() == "/flight" && knows(request) && has_key(request) && !is_foreign(request) &&
           request.find(http::field::origin) != request.end() && followers.size() < limits.followers;
  }

  bool knows(const Request& request) const {
    return request.count(http::field::host) == 1 && door.knows_host(view_of(request[http::field::host]));
  }
  bool has_key(const Request& request) const {
    return door.opens(view_of(request[http::field::cookie]), view_of(request[http::field::host]));
  }
  /// Whether a page of another site made the browser send the request. Clients other than browsers send no Origin.
  bool is_foreign(const Request& request) const {
    const auto origin = request.find(http::field::origin);
    return origin != request.end() &&
           !door.is_own_origin(view_of(origin->value()), view_of(request[http::field::host]));
  }

  Response answer(const Request& request) const {
    const auto plain = [&](http::status status, const std::string& text) {
      return made(request, status, "text/plain; charset=utf-8", text + "\n");
    };
    if (!knows(request))
      return plain(http::status::misdirected_request, "This page is not served under this host name.");
    const beast::string_view target = request.target();
    if (target == "/enter") return enter(request);
    if (is_foreign(request)) return plain(http::status::forbidden, "Only a page of this server may ask for that.");
    if (request.method() != http::verb::get) return plain(http::status::method_not_allowed, "Only GET.");
    const bool open = has_key(request);
    if (target == "/") return open ? made(request, http::status::ok, kHtml, site.page) : knocked(request);
    if (target != "/live.js" && target != "/flight") return plain(http::status::not_found, "There is no such page.");
    if (!open) return plain(http::status::forbidden, "Show the key first.");
    if (target == "/flight" && followers.size() >= limits.followers) {
      return plain(http::status::service_unavailable, "Too many browsers follow this run already.");
    }
    if (target == "/flight") return plain(http::status::upgrade_required, "This is a WebSocket for this page alone.");
    return made(request, http::status::ok, "text/javascript; charset=utf-8", site.script);
  }

  /// The login page has no secret, so pages of other origins may load it: the file with the key (key_file_page()) thus
  /// learns that the server answers.
  static Response knocked(const Request& request) {
    Response response = made(request, http::status::ok, kHtml, door_page());
    response.set("Cross-Origin-Resource-Policy", "cross-origin");
    return response;
  }

  /// The key comes from the file that the user opened, or from the form of the login page. The right key suffices, so
  /// the Origin header is not checked.
  Response enter(const Request& request) const {
    if (request.method() != http::verb::post || !door.key().opens(form_field(request.body(), "key"))) {
      return made(request, http::status::forbidden, kHtml, door_page(true));
    }
    // No redirection: a browser does not send a SameSite=Strict cookie if a page of another site began the request.
    Response response = made(request, http::status::ok, kHtml, entered_page());
    response.set(http::field::set_cookie, door.cookie(view_of(request[http::field::host])));
    return response;
  }

  static constexpr const char* kHtml = "text/html; charset=utf-8";

  static Response made(const Request& request, http::status status, const char* type, std::string body) {
    Response response(status, request.version());
    response.set(http::field::content_type, type);
    response.set(http::field::cache_control, "no-store");
    response.set("Content-Security-Policy", page_policy());
    response.set("X-Content-Type-Options", "nosniff");
    response.set("X-Frame-Options", "DENY");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.keep_alive(false);
    response.body() = std::move(body);
    response.prepare_payload();
    return response;
  }

  asio::awaitable<void> follow(std::shared_ptr<Follower> follower, Request request) {
    WebSocket& socket = follower->socket;
    boost::system::error_code error;
    beast::get_lowest_layer(socket).socket().set_option(tcp::socket::send_buffer_size(kSendBuffer), error);
    beast::get_lowest_layer(socket).expires_never();  // the WebSocket has its own timeouts
    socket.set_option(websocket::stream_base::timeout{limits.request, limits.silence, true});
    socket.read_message_max(kMostMessage);
    socket.text(true);
    co_await socket.async_accept(request, use_awaitable);
    follower->closing = closing;
    spawn(listen_to(follower), [follower] {
      leave(*follower);
      beast::get_lowest_layer(follower->socket).close();
    });
    co_await tell(*follower, error);
    if (!error) {
      co_await socket.async_close(websocket::close_code::going_away, asio::redirect_error(use_awaitable, error));
    } else {
      beast::get_lowest_layer(socket).close();
    }
  }

  asio::awaitable<void> tell(Follower& follower, boost::system::error_code& error) {
    while (true) {
      if (std::chrono::steady_clock::now() >= follower.looks_until) follower.place.look_at({});
      const std::string message = feed.next(follower.place, kBatch);
      if (message.empty()) {
        if (follower.closing) co_return;
        boost::system::error_code woken;
        follower.news.expires_at(asio::steady_timer::time_point::max());
        co_await follower.news.async_wait(asio::redirect_error(use_awaitable, woken));
        continue;
      }
      co_await follower.socket.async_write(asio::buffer(message), asio::redirect_error(use_awaitable, error));
      if (error) co_return;
      if (follower.closing || follower.place.more) continue;
      boost::system::error_code woken;
      follower.pause.expires_after(kPause);
      co_await follower.pause.async_wait(asio::redirect_error(use_awaitable, woken));
    }
  }

  asio::awaitable<void> listen_to(std::shared_ptr<Follower> follower) {
    beast::flat_buffer buffer;
    while (true) {
      co_await follower->socket.async_read(buffer, use_awaitable);
      const auto order = follower->socket.got_text()
                             ? read_order(view_of(beast::string_view(static_cast<const char*>(buffer.data().data()),
                                                                     buffer.data().size())))
                             : std::nullopt;
      buffer.consume(buffer.size());
      if (!order) {
        beast::get_lowest_layer(follower->socket).close();
        co_return;
      }
      if (const auto* look = std::get_if<LookOrder>(&*order)) {
        follower->place.look_at(clouds_of(*look));
        follower->looks_until = std::chrono::steady_clock::now() + kLookLease;
        follower->news.cancel();  // wakes tell(): clouds may be there already
      }
      if (obey) obey(*order);
    }
  }

  const Door door;
  const Site site;
  Feed& feed;
  const Obey obey;
  const ServerLimits limits;
  asio::io_context io{1};
  tcp::acceptor acceptor;
  asio::steady_timer last_call{io};
  std::vector<std::shared_ptr<Visitor>> visitors;  ///< in the order in which they connected
  std::vector<std::shared_ptr<Follower>> followers;
  std::size_t at_work = 0;  ///< running coroutines
  bool closing = false;
  std::atomic<bool> told = false;  ///< tell_news() is already posted
  std::thread thread;
};

Server::Server(int listener, Key key, Site site, Feed& feed, Obey obey, const ServerLimits& limits)
    : impl_(std::make_unique<Impl>(listener, std::move(key), std::move(site), feed, std::move(obey), limits)) {}

Server::~Server() = default;

void Server::stop() {
  if (impl_) impl_->end(std::chrono::milliseconds(0));
  impl_.reset();  // closes all connections
}

}  // namespace skein::view
