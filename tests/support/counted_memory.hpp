// Counts the memory that a program allocates. Linking skein_counted_memory replaces operator new and delete in the
// whole program, so tests that use it have a program of their own: skein_add_test(... ALONE ...). With AddressSanitizer
// or ThreadSanitizer nothing is replaced: their own hooks count, and they still detect every wrong deallocation.
#pragma once

#include <cstddef>

namespace skein::test {

/// While it lives, counts what all threads allocate with operator new (with sanitizers: with any allocator). At most
/// one instance at a time.
class CountedMemory {
 public:
  CountedMemory();
  ~CountedMemory();
  CountedMemory(const CountedMemory&) = delete;
  CountedMemory& operator=(const CountedMemory&) = delete;

  /// Bytes allocated so far, whether released again or not.
  std::size_t allocated() const;
  /// Maximum number of bytes in use at one time, beyond those in use at the start.
  std::size_t peak() const;
};

}  // namespace skein::test
