#include "sim/memory.hpp"

#include <malloc.h>

namespace havers::sim {

void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 1 << 25);  // larger blocks are never kept: glibc allows no more
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

}  // namespace havers::sim
