#include "tests/support/counted_memory.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SKEIN_SANITIZER_COUNTS 1
// From the sanitizers' allocator_interface.h, which Debian's GCC lacks.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*after_new)(const volatile void*, std::size_t),
                                                         void (*before_delete)(const volatile void*));
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* block);
#else
#include <malloc.h>
#endif

namespace {

std::atomic<bool> counting = false;
std::atomic<std::ptrdiff_t> allocated_bytes = 0, bytes_in_use = 0, peak_in_use = 0;

void count_new(std::size_t size) {
  if (!counting) return;
  const auto bytes = static_cast<std::ptrdiff_t>(size);
  allocated_bytes += bytes;
  const std::ptrdiff_t in_use = bytes_in_use += bytes;
  std::ptrdiff_t peak = peak_in_use;
  while (in_use > peak && !peak_in_use.compare_exchange_weak(peak, in_use)) {
  }
}

/// Memory that was allocated before the count began may be released during it, so the sum may be negative.
void count_delete(std::size_t size) {
  if (counting) bytes_in_use -= static_cast<std::ptrdiff_t>(size);
}

}  // namespace

#ifdef SKEIN_SANITIZER_COUNTS

namespace {

void after_new(const volatile void*, std::size_t size) { count_new(size); }
void before_delete(const volatile void* block) {
  if (block) count_delete(__sanitizer_get_allocated_size(block));
}
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(after_new, before_delete);

}  // namespace

#else

// Not inlined, or the compiler warns that allocation and deallocation functions do not match.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* block = std::malloc(size > 0 ? size : 1);
  if (block) count_new(malloc_usable_size(block));
  return block;
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* block = operator new(size, std::nothrow)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* block) noexcept {
  count_delete(malloc_usable_size(block));
  std::free(block);
}
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { operator delete(block); }

#endif

namespace skein::test {

CountedMemory::CountedMemory() {
  allocated_bytes = bytes_in_use = peak_in_use = 0;
  counting = true;
}
CountedMemory::~CountedMemory() { counting = false; }

std::size_t CountedMemory::allocated() const { return static_cast<std::size_t>(allocated_bytes.load()); }
std::size_t CountedMemory::peak() const { return static_cast<std::size_t>(peak_in_use.load()); }

}  // namespace skein::test
