// What a shell offers when somebody presses the tabulator key after `skein ...`. The shells' scripts (cli/completion/)
// ask `skein --complete WORD...`, so that they know nothing themselves.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace skein::cli {

/// Names that only the installation knows; each is called when it is needed.
struct KnownNames {
  std::function<std::vector<std::string>()> scenarios, planners;
};

/// @param words  after `skein`, up to the cursor; the last one is being typed, and may be empty.
/// @returns what the last word may become; nothing where any text or file will do.
std::vector<std::string> completions(const std::vector<std::string>& words, const KnownNames& known);

}  // namespace skein::cli
