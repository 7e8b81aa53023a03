#include "cli/run/crash_trace.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "cli/run/supervisor.hpp"
#include "core/text.hpp"
#include "process/crash_notes.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kMostLines = 100;

struct Frame {
  std::string file, offset;
};

/// Those below the last head.
std::vector<Frame> frames_in(const std::vector<std::string>& lines) {
  const auto head = std::find_if(lines.rbegin(), lines.rend(),
                                 [](const std::string& line) { return line.starts_with(crash_notes::kHead); });
  std::vector<Frame> frames;
  if (head == lines.rend()) return frames;
  for (auto line = head.base(); line != lines.end() && line->starts_with(crash_notes::kFrame); ++line) {
    const std::size_t begin = crash_notes::kFrame.size(), cut = line->rfind(" +");
    if (cut == std::string::npos || cut < begin) break;
    frames.push_back({line->substr(begin, cut - begin), line->substr(cut + 2)});
  }
  return frames;
}

/// "NAME at FILE:LINE", and what was inlined there in lines of its own; as it was where nobody knows.
std::string named(const Frame& frame) {
  const std::string unknown = frame.file + " +" + frame.offset + "\n";
  const std::string command =
      "addr2line -Cfipe " + shell_word(frame.file) + " " + shell_word(frame.offset) + " 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "re"), ::pclose);
  std::string text;
  char part[512];
  while (pipe && std::fgets(part, sizeof part, pipe.get()) != nullptr) text += part;
  text = std::regex_replace(text, std::regex(" \\(discriminator [0-9]+\\)"), "");
  return text.empty() || text.starts_with("?? ") ? unknown : text;
}

}  // namespace

bool explain_crash(const std::filesystem::path& log) {
  const std::vector<Frame> frames = frames_in(last_lines(log, kMostLines));
  if (frames.empty()) return false;
  std::ofstream out(log, std::ios::app);
  out << "[skein] with names, as far as there are symbols:\n";
  for (std::size_t i = 0; i < frames.size(); ++i) out << "  #" << i << " " << named(frames[i]);
  return true;
}

}  // namespace skein::cli
