// The page's WebSocket without a browser: reads what a run tells, and asks for what a page may ask for.
// Threads: one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skein::test {

class PageClient {
 public:
  using Json = nlohmann::json;

  /// @param door  the file that opens the page. Connects at once, and again whenever the station goes.
  explicit PageClient(const std::filesystem::path& door);
  ~PageClient();
  PageClient(const PageClient&) = delete;
  PageClient& operator=(const PageClient&) = delete;

  void ask(const Json& order);
  /// Takes in what comes until a fact holds. @returns false when the run is over before, or nothing comes any more.
  bool wait(const std::function<bool()>& holds);

  /// The newest, null before there is any; and all lines of the flight, from the last connection on.
  const Json& state() const { return state_; }
  const std::vector<Json>& lines() const { return lines_; }
  bool over() const { return over_; }

 private:
  void open();
  bool read_more();
  bool take_frame();
  void close();

  std::string key_;
  std::uint16_t port_ = 0;
  int fd_ = -1;
  std::string heard_, message_;  ///< bytes not looked at; what its frames so far make of a message
  Json state_;
  std::vector<Json> lines_;
  bool over_ = false;
};

}  // namespace skein::test
