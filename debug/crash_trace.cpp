#include "debug/crash_trace.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text/text.hpp"
#include "debug/core_file.hpp"
#include "host/supervisor.hpp"
#include "process/health/crash_notes.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kMostLines = 400, kFramesQuoted = 5;
constexpr std::string_view kNamesHead = "[skein] the same backtrace with names, where symbols are known:";

struct Frame {
  std::string file, offset;
};

using Lines = std::vector<std::string>;

Lines::const_iterator last_with(const Lines& lines, std::string_view begin) {
  const auto found =
      std::find_if(lines.rbegin(), lines.rend(), [&](const std::string& line) { return line.starts_with(begin); });
  return found == lines.rend() ? lines.end() : std::prev(found.base());
}

/// The frames of the last crash in a log.
std::vector<Frame> frames_in(const Lines& lines) {
  std::vector<Frame> frames;
  auto line = last_with(lines, crash_notes::kHead);
  if (line == lines.end()) return frames;
  for (++line; line != lines.end() && line->starts_with(crash_notes::kFrame); ++line) {
    const std::size_t begin = crash_notes::kFrame.size(), cut = line->rfind(" +");
    if (cut == std::string::npos || cut < begin) break;
    frames.push_back({line->substr(begin, cut - begin), line->substr(cut + 2)});
  }
  return frames;
}

/// addr2line's text for each of these frames of one file: "NAME at FILE:LINE", with one more line for each function
/// inlined there. Empty: addr2line does not know the frame.
Lines names_of(const std::string& file, const std::vector<std::string>& offsets) {
  Lines names;
  const std::string command = "addr2line -Capfie " + shell_word(file) + " " + shell_line(offsets) + " 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "re"), ::pclose);
  std::string said;
  char part[4096];
  while (pipe && std::fgets(part, sizeof part, pipe.get()) != nullptr) said += part;
  static const std::regex kDiscriminator(" \\(discriminator [0-9]+\\)");
  for (const std::string& line : split(std::regex_replace(said, kDiscriminator, ""), '\n')) {
    const std::size_t name = line.find(": ");  // after the address, which lines of inlined functions lack
    if (line.starts_with("0x") && name != std::string::npos) {
      names.push_back(line.compare(name + 2, 2, "??") == 0 ? "" : line.substr(name + 2) + "\n");
    } else if (!line.empty() && !names.empty() && !names.back().empty()) {
      names.back() += line + "\n";
    }
  }
  names.resize(offsets.size());
  return names;
}

/// The text of each frame: names, or file and offset if these are unknown. Calls addr2line once for each file, since
/// reading the symbols takes most of the time.
Lines named(const std::vector<Frame>& frames) {
  std::map<std::string, std::vector<std::size_t>> by_file;
  for (std::size_t i = 0; i < frames.size(); ++i) by_file[frames[i].file].push_back(i);
  Lines texts(frames.size());
  for (const auto& [file, places] : by_file) {
    std::vector<std::string> offsets;
    for (const std::size_t i : places) offsets.push_back(frames[i].offset);
    const Lines names = names_of(file, offsets);
    for (std::size_t k = 0; k < places.size(); ++k) {
      texts[places[k]] = names[k].empty() ? file + " +" + offsets[k] + "\n" : names[k];
    }
  }
  return texts;
}

}  // namespace

bool explain_crash(const std::filesystem::path& log) {
  const std::vector<Frame> frames = frames_in(last_lines(log, kMostLines));
  if (frames.empty()) return false;
  std::ofstream out(log, std::ios::app);
  out << kNamesHead << '\n';
  const Lines names = named(frames);
  for (std::size_t i = 0; i < names.size(); ++i) out << "  #" << i << " " << names[i];
  return true;
}

std::string crash_evidence(const ExitStatus& exit, const std::filesystem::path& log, bool with_core) {
  if (exit.signal == 0) return {};
  std::string text = explain_crash(log) ? "backtrace in " + log.filename().string() : "";
  if (!with_core || exit.pid == 0) return text;
  std::filesystem::path core = log;
  const std::string kept = keep_core(exit.pid, core.replace_extension(".core"));
  return text + (text.empty() || kept.empty() ? "" : ", ") + kept;
}

std::string end_of_log(const std::filesystem::path& log, std::size_t count) {
  Lines lines = last_lines(log, kMostLines);
  Lines frames;
  const auto head = last_with(lines, crash_notes::kHead), names = last_with(lines, kNamesHead);
  if (names != lines.end() && std::none_of(names + 1, lines.cend(), [](const auto& line) { return line[0] == '['; })) {
    frames.assign(names + 1, std::min(names + 1 + kFramesQuoted, lines.cend()));
    lines.erase(head, lines.cend());
    while (!lines.empty() && lines.back().empty()) lines.pop_back();
  }
  if (lines.size() > count) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(count));
  std::string text;
  for (const Lines* part : {&std::as_const(lines), &std::as_const(frames)}) {
    for (const std::string& line : *part) text += "\n    " + line;
  }
  return text;
}

}  // namespace skein::cli
