// A temporary folder for the tests of the file readers. Not part of any program.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "core/types.hpp"

namespace skein::sim {

class ScratchFiles : public ::testing::Test {
 protected:
  ScratchFiles() {
    std::string pattern = (std::filesystem::path(::testing::TempDir()) / "skein_files_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~ScratchFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  /// The message of the InputError with which `read` refuses the file; "accepted" if there is none.
  static std::string complaint(const std::function<void(const std::filesystem::path&)>& read,
                               const std::filesystem::path& file) {
    try {
      read(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

}  // namespace skein::sim
