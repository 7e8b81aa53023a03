#include "cli/standard_output.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <iostream>

namespace skein::cli {

std::string lost_output() {
  std::cout.flush();
  struct stat output {};
  if (std::cout || ::fstat(STDOUT_FILENO, &output) != 0 || S_ISFIFO(output.st_mode) || S_ISSOCK(output.st_mode)) {
    return {};
  }
  return "standard output: cannot be written; what was printed there is incomplete";
}

}  // namespace skein::cli
