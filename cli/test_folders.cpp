#include "cli/test_folders.hpp"

#include <algorithm>
#include <fstream>

#include "core/text/suggestion.hpp"
#include "core/types.hpp"

namespace skein::cli {

std::string labels_of_folders(const std::vector<std::string>& folders, const std::filesystem::path& list) {
  std::ifstream in(list);
  std::vector<std::string> known, top;
  for (std::string folder; std::getline(in, folder);) {
    known.push_back(folder);
    if (folder.find('/') == std::string::npos) top.push_back(folder);
  }
  std::vector<std::string> chosen;
  for (std::string folder : folders) {
    if (folder.ends_with('/')) folder.pop_back();  // as a shell completes it
    if (std::find(known.begin(), known.end(), folder) == known.end()) {
      throw InputError("test: there are no tests in a folder '" + folder + "' of the source tree; " +
                       suggestion(folder, folder.find('/') == std::string::npos ? top : known));
    }
    chosen.push_back(folder);
  }
  return "^(" + joined(chosen, "|") + ")(/|$)";
}

}  // namespace skein::cli
