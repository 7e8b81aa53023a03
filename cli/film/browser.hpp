// Chromium without a window, told over its DevTools pipe what to load and asked for pictures. A pipe and not a port: a
// port would be open to everybody on this host.   Threads: one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/film/piped_program.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

struct PictureSize {
  int width = 1280, height = 720;
};

class Browser {
 public:
  /// @param chromium  the program. @param scratch  a folder for its profile and its log.
  /// @throws std::system_error, std::runtime_error when it does not start; Interrupted, as all that follows.
  Browser(const std::filesystem::path& chromium, const std::filesystem::path& scratch, const HeldSignals& signals);

  /// Loads a page. @throws std::runtime_error with Chromium's reason.
  void open(const std::filesystem::path& file, PictureSize size);
  /// What a script comes to, when its promise is kept. @throws std::runtime_error with what it threw.
  Json evaluate(const std::string& script);
  /// What is to be seen, as PNG.
  std::vector<std::uint8_t> picture();
  /// Ends it.
  void close();

 private:
  /// @returns "result" of the answer.
  Json call(const std::string& method, Json parameters);
  std::string next_message();

  PipedProgram program_;
  std::string received_;
  std::string session_;  ///< of the page; empty: of the browser
  int last_call_ = 0;
};

/// As an address: what means something in one is written by its number.
std::string file_url(const std::filesystem::path& file);

}  // namespace skein::cli
