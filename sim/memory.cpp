#include "sim/memory.hpp"

#include <malloc.h>
#include <sys/mman.h>

#include <memory>

namespace havers::sim {

void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 1 << 25);  // larger blocks are never kept: glibc allows no more
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

void ask_for_large_pages(void* block, std::size_t bytes) {
  constexpr std::size_t page = std::size_t{1} << 21U;
  if (std::align(page, page, block, bytes) == nullptr) return;  // from its first whole page on
  madvise(block, bytes - bytes % page, MADV_HUGEPAGE);
}

}  // namespace havers::sim
