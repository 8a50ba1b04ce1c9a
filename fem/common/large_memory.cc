#include "fem/common/large_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <mutex>

namespace fem::large_memory {
namespace {

constexpr std::size_t huge_page = 2u << 20;

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + huge_page - 1) / huge_page * huge_page;
}

struct Block {
  char* begin = nullptr;
  std::size_t bytes = 0;
};

std::mutex& lock() {
  static std::mutex mutex;
  return mutex;
}

/// Blocks that were given back, by rising size. No two of them touch.
std::vector<Block>& kept() {
  static std::vector<Block> blocks;
  return blocks;
}

std::size_t sum_of_kept() {
  std::size_t sum = 0;
  for (const Block& block : kept()) sum += block.bytes;
  return sum;
}

/// Bytes that arrays have at the moment, and the most that they have had at once.
struct InUse {
  std::size_t now = 0, most = 0;
};

InUse& in_use() {
  static InUse bytes;
  return bytes;
}

/// Joined with the kept blocks on both sides, which it was cut from or grown beside.
void keep(Block block) {
  auto& blocks = kept();
  for (auto other = blocks.begin(); other != blocks.end();) {
    const bool is_before = other->begin + other->bytes == block.begin;
    if (!is_before && block.begin + block.bytes != other->begin) {
      ++other;
      continue;
    }
    block = {is_before ? other->begin : block.begin, block.bytes + other->bytes};
    other = blocks.erase(other);
  }
  const auto is_smaller = [](const Block& a, const Block& b) { return a.bytes < b.bytes; };
  blocks.insert(std::upper_bound(blocks.begin(), blocks.end(), block, is_smaller), block);
}

/// Arrays of ever other sizes leave pieces that fit none. All that is kept and in use together is never more
/// than was in use at once: the smallest pieces go.
void drop_what_is_too_much() {
  auto& blocks = kept();
  std::size_t sum = in_use().now + sum_of_kept();
  while (!blocks.empty() && sum > in_use().most) {
    sum -= blocks.front().bytes;
    munmap(blocks.front().begin, blocks.front().bytes);
    blocks.erase(blocks.begin());
  }
}

void unmap_kept() {
  for (const Block& block : kept()) munmap(block.begin, block.bytes);
  kept().clear();
}

/// The beginning of the smallest block that holds so much; what is left of it stays.
/// @return nothing if there is none
Block cut_from_kept(std::size_t bytes) {
  auto& blocks = kept();
  const auto found =
      std::find_if(blocks.begin(), blocks.end(), [&](const Block& b) { return b.bytes >= bytes; });
  if (found == blocks.end()) return {};
  const Block block = *found;
  blocks.erase(found);
  if (block.bytes > bytes) keep({block.begin + bytes, block.bytes - bytes});
  return {block.begin, bytes};
}

Block fresh(std::size_t bytes) {
  // One huge page more, so that a whole number of them lies within; the ends go back at once.
  void* const mapped =
      mmap(nullptr, bytes + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) return {};
  char* const start = static_cast<char*>(mapped);
  const std::size_t before = (huge_page - reinterpret_cast<std::size_t>(start) % huge_page) % huge_page;
  if (before > 0) munmap(start, before);
  if (before < huge_page) munmap(start + before + bytes, huge_page - before);
  madvise(start + before, bytes, MADV_HUGEPAGE);
  return {start + before, bytes};
}

/// The largest kept block, made larger: what it has of memory moves with it.
/// @return nothing if there is none, or the system refuses
Block grown(std::size_t bytes) {
  auto& blocks = kept();
  if (blocks.empty()) return {};
  const Block place = fresh(bytes);  // the system's own choice would not begin with a huge page
  if (place.begin == nullptr) return {};
  const Block largest = blocks.back();
  blocks.pop_back();
  if (mremap(largest.begin, largest.bytes, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, place.begin) != MAP_FAILED)
    return place;
  keep(largest);  // the place is lost, and may be another's by now
  return {};
}

}  // namespace

void* take(std::size_t bytes) {
  const std::lock_guard<std::mutex> guard(lock());
  bytes = whole_pages(bytes);
  Block block = cut_from_kept(bytes);
  if (block.begin == nullptr) block = grown(bytes);
  if (block.begin == nullptr) block = fresh(bytes);
  if (block.begin == nullptr) {
    unmap_kept();
    block = fresh(bytes);
  }
  if (block.begin == nullptr) throw std::bad_alloc();
  in_use().now += bytes;
  in_use().most = std::max(in_use().most, in_use().now);
  drop_what_is_too_much();
  return block.begin;
}

void give_back(void* memory, std::size_t bytes) noexcept {
  const std::lock_guard<std::mutex> guard(lock());
  bytes = whole_pages(bytes);
  in_use().now -= bytes;
  try {
    keep({static_cast<char*>(memory), bytes});
  } catch (const std::bad_alloc&) {  // no place in the list
    munmap(memory, bytes);
  }
}

std::size_t bytes_kept() {
  const std::lock_guard<std::mutex> guard(lock());
  return sum_of_kept();
}

void release_kept() {
  const std::lock_guard<std::mutex> guard(lock());
  unmap_kept();
  in_use().most = in_use().now;
}

}  // namespace fem::large_memory
