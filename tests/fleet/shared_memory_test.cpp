#include "shared_memory.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>

#include "child_process.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::test {
namespace {

/// Uses a folder of its own in place of /dev/shm, because other tests check /dev/shm.
class SharedMemory : public testing::Test {
 protected:
  SharedMemory() { std::ofstream(scratch_.path() / kName) << std::string(4096, 'x'); }

  bool is_there() const { return shared_memory(scratch_.path()).contains(kName); }
  bool is_used() const { return unused_shared_memory({kName}, scratch_.path()).empty(); }
  /// A process that executes this Python with the name's path as argument, says "ready", and sleeps.
  Arguments python(const std::string& code) const {
    const std::string program = "import ctypes, sys, time\n" + code + "\nprint('ready', flush=True)\ntime.sleep(1000)";
    return {"/usr/bin/python3", "-c", program, scratch_.path() / kName};
  }

  const std::string kName = "segment";
  const ScratchFolder scratch_;
  const ScratchFolder output_;
};

TEST_F(SharedMemory, IsUnusedIfNoProcessHasItOpen) {
  EXPECT_TRUE(is_there());
  EXPECT_FALSE(is_used());
}

TEST_F(SharedMemory, IsUsedUntilTheProcessThatHasItOpenOrMappedIsKilled) {
  const std::string open = "segment = open(sys.argv[1], 'rb')\n";
  const std::string map =
      open +
      "mmap = ctypes.CDLL(None).mmap\n"
      "mmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int, ctypes.c_int, ctypes.c_int, ctypes.c_long]\n"
      "mmap.restype = ctypes.c_void_p\n"
      "mmap(None, 4096, 1, 1, segment.fileno(), 0)\n"  // PROT_READ, MAP_SHARED
      "segment.close()\n";
  for (const std::string& code : {open, map}) {
    ChildProcess process(python(code), {}, output_.path() / "out", output_.path() / "err");
    ASSERT_TRUE(eventually([&] { return process.out().find("ready") != std::string::npos; })) << process.err();
    EXPECT_TRUE(is_used()) << code;
    process.signal(SIGKILL);
    process.wait();
    EXPECT_FALSE(is_used()) << code;
    EXPECT_TRUE(is_there()) << code;
  }
}

}  // namespace
}  // namespace skein::test
