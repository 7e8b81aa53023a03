#include "run/repeat_command.hpp"

#include <algorithm>
#include <vector>

#include "core/text/text.hpp"
#include "core/types.hpp"
#include "view/endpoint.hpp"

namespace skein::cli {
namespace {

using Words = std::vector<std::string>;

/// Number of words from `at` on that `option` and its value take; 0: the word at `at` is another option.
std::size_t option_words(const Words& words, std::size_t at, const std::string& option, bool valued) {
  if (words[at].starts_with(option + "=")) return 1;
  if (words[at] != option) return 0;
  return valued && at + 1 < words.size() ? 2 : 1;
}

/// Whether a word is an endpoint: the optional value of --view.
bool is_endpoint(const std::string& word) {
  try {
    view::read_endpoint(word);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::size_t watching_words(const Words& words, std::size_t at) {
  const bool has_place = at + 1 < words.size() && is_endpoint(words[at + 1]);
  std::size_t count = option_words(words, at, "--view", has_place);
  for (const char* valued : {"--speed", "--pause-at", "--out"})
    count = std::max(count, option_words(words, at, valued, true));
  for (const char* flag : {"--view-close", "--no-browser", "--force"}) {
    count = std::max(count, option_words(words, at, flag, false));
  }
  return count;
}

}  // namespace

std::string command_repeated(const std::string& command, const Repeated& by) {
  const Words words = shell_words(command);
  Words again;
  for (std::size_t i = 0; i < words.size();) {
    if (const std::size_t count = watching_words(words, i); count > 0) {
      i += count;
    } else if (const std::size_t planner = option_words(words, i, "--planner", true); planner > 0 && by.planners) {
      again.insert(again.end(), {"--planner", *by.planners});
      i += planner;
    } else if (const std::size_t faults = option_words(words, i, "--faults", true); faults > 0 && by.faults) {
      i += faults;
    } else {
      again.push_back(words[i++]);
    }
  }
  if (by.faults) again.insert(again.end(), {"--faults", by.faults->string()});
  return shell_line(again);
}

}  // namespace skein::cli
