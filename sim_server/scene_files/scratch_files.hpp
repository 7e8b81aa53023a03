// For the tests of the file readers: a folder that goes away again, and seeded damage. Not part of any program.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "core/random_stream.hpp"
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

  /// What `read` has against the file; "accepted" when nothing.
  static std::string complaint(const std::function<void(const std::filesystem::path&)>& read,
                               const std::filesystem::path& file) {
    try {
      read(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  /// Damages `original` in many ways; only an InputError that names the file may come of it.
  void expect_only_input_errors(const std::string& original,
                                const std::function<void(const std::filesystem::path&)>& read) const {
    constexpr std::uint64_t kRounds = 400;
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      RandomStream random(1, "scene_files_fuzz", original.size(), round);
      std::string bytes = original;
      for (std::uint64_t damages = 1 + random.bits() % 4; damages > 0; --damages) damage(random, bytes);
      const auto file = write("damaged", bytes);
      try {
        read(file);
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      } catch (const std::exception& error) {
        ADD_FAILURE() << "round " << round << ": " << error.what();
      }
    }
  }

  std::filesystem::path folder_;

 private:
  static void damage(RandomStream& random, std::string& bytes) {
    if (bytes.empty()) return;
    // Every other damage falls on the first bytes: that is where headers are.
    const std::size_t reach = random.bits() % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 256);
    const std::size_t at = random.bits() % reach;
    const std::size_t length = random.bits() % 60;
    switch (random.bits() % 5) {
      case 0:
        bytes[at] = static_cast<char>(random.bits());
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(random.bits() % bytes.size(), length));
        break;
      default:
        bytes[at] = static_cast<char>('0' + random.bits() % 10);
    }
  }
};

}  // namespace skein::sim
