#include "run/browser.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>

#include "core/files/command_file.hpp"
#include "host/program_start.hpp"

namespace skein::cli {
namespace {

/// The command line of one entry of $BROWSER: the file replaces %s, or is appended. Empty: there is no such command.
std::vector<std::string> filled_in(const std::string& entry, const std::string& file) {
  std::istringstream in(entry);
  std::vector<std::string> words;
  bool placed = false;
  for (std::string word; in >> word;) {
    if (const std::size_t at = word.find("%s"); at != std::string::npos) {
      word.replace(at, 2, file);
      placed = true;
    }
    words.push_back(word);
  }
  if (words.empty() || command_file(words[0]).empty()) return {};
  if (!placed) words.push_back(file);
  words[0] = command_file(words[0]);
  return words;
}

}  // namespace

std::vector<std::string> browser_command(const std::filesystem::path& file,
                                         const std::function<const char*(const char*)>& variable) {
  const auto is_set = [&](const char* name) {
    const char* const value = variable(name);
    return value != nullptr && *value != '\0';
  };
  if (is_set("SSH_CONNECTION") || (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))) return {};
  if (is_set("BROWSER")) {
    std::istringstream entries(variable("BROWSER"));
    for (std::string entry; std::getline(entries, entry, ':');) {
      if (std::vector<std::string> words = filled_in(entry, file); !words.empty()) return words;
    }
  }
  return filled_in("xdg-open", file);
}

bool start_browser(const std::vector<std::string>& command) {
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {  // from here on only calls that are safe after a fork
    ::setsid();
    const pid_t browser = ::fork();
    if (browser != 0) ::_exit(browser < 0 ? 1 : 0);
    reset_signals();
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, fd);
    ::close_range(STDERR_FILENO + 1, ~0U, 0);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace skein::cli
