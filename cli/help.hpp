// What `skein` prints about itself: help, version, manual page, and tab completion.
#pragma once

#include <string>
#include <vector>

#include "cli/console.hpp"

namespace skein::cli {

/// --help or --version: what to print.
struct HelpText {
  std::string text;
  bool names_planners = false;  ///< append a list of the available planners
};

/// --complete, which a shell calls for completion: the words up to the cursor.
struct CompletionOptions {
  std::vector<std::string> words;
};

/// --help and --version: prints the text, and on request the planners of the default agent program. If that program
/// fails, its error takes the place of the list. @returns kExitDone
int print_help(const HelpText& help, const Console& console);

/// --complete: prints completions of the last word, one per line. @returns kExitDone
int print_completions(const CompletionOptions& options, const Console& console);

}  // namespace skein::cli
