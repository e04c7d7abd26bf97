// A process and all that it has started.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace contactcheck {

/// `root` and its descendants, as far as the kernel tells (children of one that has ended are its
/// no longer).
std::vector<pid_t> process_tree(pid_t root);

/// Their resident memory, bytes; pages that they share count as often.
std::uint64_t resident_bytes_of_tree(pid_t root);

/// Ends them all. @pre root has not been reaped
void kill_tree(pid_t root);

}  // namespace contactcheck
