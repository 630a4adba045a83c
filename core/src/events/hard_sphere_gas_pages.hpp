// Memory in huge pages where the system has them.
//
// A gas of 1e5 spheres fills 20 MB and touches it at random. With pages of 4 KiB nearly every touch also misses the
// processor's table of pages; with pages of 2 MiB ten entries cover it all.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace plumbline {

template <class T>
struct HugePages {
  using value_type = T;
  static constexpr std::size_t kHuge = std::size_t{1} << 21;

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) {}

  static std::align_val_t alignment(std::size_t bytes) { return std::align_val_t{bytes < kHuge ? 64 : kHuge}; }

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* memory = ::operator new(bytes, alignment(bytes));
#if defined(__linux__)
    // A wish, not a need: where it is not granted, things are only slower.
    if (bytes >= kHuge) madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignment(count * sizeof(T))); }
  bool operator==(const HugePages&) const = default;
};

template <class T>
using PagedVector = std::vector<T, HugePages<T>>;

}  // namespace plumbline
