// Ctrl-C asks for a clean end; a second one ends at once.
#pragma once

namespace havers::cli {

/// From now on SIGINT and SIGTERM set a flag that observers ask for, but for those that the parent
/// ignores. Only for commands that ask: in the others both do what they do by themselves.
void catch_interrupts();

/// Whether the user asked to stop. From any thread.
bool interrupted();

}  // namespace havers::cli
