// For tests: a temporary folder, and text files in it.
#pragma once

#include "tests/support/scratch_folder.hpp"
#include "tests/support/text_files.hpp"

namespace skein::results {

using Scratch = ScratchFolder;

}  // namespace skein::results
