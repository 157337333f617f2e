// What a process does with memory that it has freed.
#pragma once

namespace havers::sim {

/// Keeps freed memory for what comes next, up to 1 GiB, instead of handing it back to the system:
/// simulations ask for the same blocks again and again, and fresh pages can take as long as what is
/// done in them. For all threads; to be called by a program as it starts.
void keep_freed_memory();

}  // namespace havers::sim
