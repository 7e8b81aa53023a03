// The page's WebSocket without a browser: reads what a run sends, and sends requests as a page does.
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

  /// @param door  the file that opens the page. Connects at once, and again whenever the station disconnects.
  explicit PageClient(const std::filesystem::path& door);
  ~PageClient();
  PageClient(const PageClient&) = delete;
  PageClient& operator=(const PageClient&) = delete;

  void ask(const Json& order);
  /// Processes messages until `holds()`. @returns false when the run is over before, or the station cannot be reached.
  bool wait(const std::function<bool()>& holds);

  /// The newest state, null before the first one; and all lines of the flight since the last connection.
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
  std::string heard_, message_;  ///< bytes not yet processed; the message so far, from its frames
  Json state_;
  std::vector<Json> lines_;
  bool over_ = false;
};

}  // namespace skein::test
