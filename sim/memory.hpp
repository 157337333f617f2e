// How memory is asked for: fresh pages can take as long as what is done in them.
#pragma once

#include <cstddef>

namespace havers::sim {

/// Keeps freed memory for what comes next, up to 1 GiB, instead of handing it back to the system,
/// as simulations, and steps through an image, ask for the same blocks again and again; blocks
/// above 32 MiB go back all the same. For all threads; to be called by a program as it starts.
void keep_freed_memory();

/// Asks for large pages (of 2 MiB) behind a block that nothing has touched yet; a smaller block is
/// left as it is.
void ask_for_large_pages(void* block, std::size_t bytes);

}  // namespace havers::sim
