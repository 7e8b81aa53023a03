// Memory that a program asks for while a test counts it. Linking skein_counted_memory replaces operator new and delete
// in the whole program, so its tests have a program of their own: skein_add_test(... ALONE ...). With AddressSanitizer
// or ThreadSanitizer nothing is replaced: their own hooks count, and they still see every wrong release.
#pragma once

#include <cstddef>

namespace skein::test {

/// Counts what all threads allocate with operator new (with sanitizers: with any allocator) while it lives. One at a
/// time.
class CountedMemory {
 public:
  CountedMemory();
  ~CountedMemory();
  CountedMemory(const CountedMemory&) = delete;
  CountedMemory& operator=(const CountedMemory&) = delete;

  /// Bytes allocated so far, whether released again or not.
  std::size_t allocated() const;
  /// The most bytes in use at one time, above what was in use at the start.
  std::size_t peak() const;
};

}  // namespace skein::test
