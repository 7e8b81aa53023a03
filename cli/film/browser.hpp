// Controls Chromium without a window over its DevTools pipe: loads a page, and takes pictures of it. It uses a pipe,
// since a port would be open to every user of this host.   Threads: one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/film/piped_program.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// [pixels]
struct PictureSize {
  int width = 1280, height = 720;
};

class Browser {
 public:
  /// @param chromium  its executable. @param scratch  folder for its profile and log. @param signals  outlives this.
  /// @throws std::system_error, std::runtime_error when it does not start; Interrupted, like all functions below.
  Browser(const std::filesystem::path& chromium, const std::filesystem::path& scratch, const HeldSignals& signals);

  /// Loads a page. @throws std::runtime_error with Chromium's reason.
  void open(const std::filesystem::path& file, PictureSize size);
  /// Runs a script, waits for its promise, and returns its value. @throws std::runtime_error with what it threw.
  Json evaluate(const std::string& script);
  /// The page as it is shown, as PNG.
  std::vector<std::uint8_t> picture();
  /// Ends Chromium, and waits for its end.
  void close();

 private:
  /// Calls a DevTools method, and waits for the answer. @returns its "result".
  Json call(const std::string& method, Json parameters);
  std::string next_message();

  PipedProgram program_;
  std::string received_;
  std::string session_;  ///< DevTools session of the page; empty: calls go to the browser
  int last_call_ = 0;
};

/// The file:// URL of a file, with special characters percent-encoded.
std::string file_url(const std::filesystem::path& file);

}  // namespace skein::cli
