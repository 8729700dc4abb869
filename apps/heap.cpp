#include "heap.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>

#ifdef __GLIBC__  // any header of the standard library tells
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

#ifdef __SANITIZE_ADDRESS__
/// What has been given back is kept from use for a while, to find who uses it still. With the 256
/// MB of the default the program would not keep within its limits on memory.
extern "C" const char* __asan_default_options() { return "quarantine_size_mb=64"; }
#endif

namespace marrow {

#ifdef __GLIBC__

namespace {

constexpr int kRoom = 64 << 20;     // that the heap grows by; only what is used becomes memory
constexpr int kLargest = 32 << 20;  // a piece of the heap; glibc allows no more
constexpr std::size_t kNotThereYet = 1 << 20;
constexpr std::uintptr_t kLargePage = 2 << 20;

/// Where memory is limited, room that is not used counts too.
bool is_limited() {
  const auto has_limit = [](auto resource) {
    rlimit limit{};
    return ::getrlimit(resource, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY;
  };
  return has_limit(RLIMIT_AS) || has_limit(RLIMIT_DATA);
}

}  // namespace

void prepare_heap() {
  if (is_limited()) return;
  ::mallopt(M_MMAP_THRESHOLD, kLargest);
  ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  ::mallopt(M_TOP_PAD, kRoom);
  void* const piece = std::malloc(kNotThereYet);  // the heap grows
  const auto first = (reinterpret_cast<std::uintptr_t>(piece) + kLargePage - 1) & ~(kLargePage - 1);
  const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0));
  std::free(piece);
  // Where the system has no large pages, small ones do.
  if (piece != nullptr && first < end)
    ::madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
}

#else

void prepare_heap() {}

#endif

}  // namespace marrow
