// For tests of full disks: a file system of a given size (tmpfs). Needs root.
#pragma once

#include <sys/mount.h>

#include <filesystem>
#include <string>

namespace skein::test {

/// A file system that is mounted on a folder while this object lives.
class SmallDisk {
 public:
  SmallDisk(std::filesystem::path folder, int kilobytes) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    mounted_ = ::mount("none", folder_.c_str(), "tmpfs", 0, size(kilobytes).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }
  /// Changes the size; files stay. @returns whether that succeeded.
  bool grow(int kilobytes) const {
    return ::mount("none", folder_.c_str(), "tmpfs", MS_REMOUNT, size(kilobytes).c_str()) == 0;
  }

 private:
  static std::string size(int kilobytes) { return "size=" + std::to_string(kilobytes) + "k"; }

  std::filesystem::path folder_;
  bool mounted_ = false;
};

}  // namespace skein::test
