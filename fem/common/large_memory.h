/// Arrays of hundreds of megabytes whose pages stay with the process when they end, for the next ones: a
/// virtual machine takes two seconds to find a gigabyte anew. What is kept and in use together is never more
/// than was in use at once.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace fem {

namespace large_memory {

/// From here on arrays take part.
constexpr std::size_t least_bytes = 16u << 20;

/// @throws std::bad_alloc
void* take(std::size_t bytes);
void give_back(void* memory, std::size_t bytes) noexcept;

/// Of what was given back and is free for the next array.
std::size_t bytes_kept();
/// Back to the system.
void release_kept();

}  // namespace large_memory

/// Elements of plain types have no value until one is written: the threads that fill an array touch its
/// pages.
template <class T>
struct LargeAllocator {
  static_assert(std::is_trivially_copyable_v<T>);
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) noexcept {}

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    return static_cast<T*>(bytes < large_memory::least_bytes ? ::operator new(bytes)
                                                             : large_memory::take(bytes));
  }
  void deallocate(T* memory, std::size_t n) noexcept {
    const std::size_t bytes = n * sizeof(T);
    if (bytes < large_memory::least_bytes)
      ::operator delete(memory);
    else
      large_memory::give_back(memory, bytes);
  }

  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const LargeAllocator&, const LargeAllocator&) noexcept { return true; }
  friend bool operator!=(const LargeAllocator&, const LargeAllocator&) noexcept { return false; }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace fem
