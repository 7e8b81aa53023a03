// Messages between the launcher and a process with a whole fleet (one_process/): lines of several programs on one pair
// of pipes (status_pipe.hpp), each with the program's name.   Threads: any.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "process/json_text.hpp"

namespace skein::shared_lines {

// ---- from the process --------------------------------------------------------------------------------------------

/// A status line of a program (status_lines.hpp).
struct Said {
  std::string program = {};
  Json line = Json::object();
};
/// A program has ended, with an exit code or as if killed by a signal.
struct Ended {
  std::string program = {};
  int code = 0, signal = 0;
  bool fatal = false;  ///< true: the whole process, with all programs, ends
};
/// A fault has stopped a program: it gets no turns until it is continued.
struct Stopped {
  std::string program = {};
};

using News = std::variant<Said, Ended, Stopped>;

nlohmann::json said_by(const std::string& program, const nlohmann::json& line);
nlohmann::json news_json(const News& news);
/// @returns nullopt when the text is none of these.
std::optional<News> read_news(const std::string& text);

// ---- from the launcher -------------------------------------------------------------------------------------------

/// Starts a program, with the same data as for a process of its own (host/supervisor.hpp).
struct Start {
  std::string program = {};
  std::vector<std::string> argv = {};
  std::string log = {};
  bool append_log = false;
};
/// A line for a program's control pipe.
struct Tell {
  std::string program = {}, line = {};
};
/// SIGKILL, SIGCONT or SIGTERM for a program.
struct Signal {
  std::string program = {};
  int signal = 0;
};

using Order = std::variant<Start, Tell, Signal>;

/// The order as a line of text, without the end of line.
std::string text_of(const Order& order);
/// @returns nullopt when the text is none of these.
std::optional<Order> read_order(const std::string& text);

}  // namespace skein::shared_lines
