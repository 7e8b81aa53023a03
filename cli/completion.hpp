// Tab completion: the words that a shell offers after `skein ...`. The shells' scripts (cli/completion/) only call
// `skein --complete WORD...`; they contain no commands or options themselves.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace skein::cli {

/// Functions that list the installation's names; each is called only when it is needed.
struct KnownNames {
  std::function<std::vector<std::string>()> scenarios, planners;
};

/// @param words  words after `skein`, up to the cursor; the user is typing the last one, which may be empty.
/// @returns completions of the last word; empty where any text or file is allowed.
std::vector<std::string> completions(const std::vector<std::string>& words, const KnownNames& known);

}  // namespace skein::cli
