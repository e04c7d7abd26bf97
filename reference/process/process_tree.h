// A process and all that it has started.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace contactcheck::process {

/// `root` and its descendants, as far as the kernel tells (children of one that has ended are its
/// no longer).
std::vector<pid_t> process_tree(pid_t root);

/// Its resident memory; 0 when it is gone.
std::uint64_t resident_bytes(pid_t process);

/// The resident memory of a process and its descendants, bytes; shared pages count once for each.
std::uint64_t resident_bytes_of_tree(pid_t root);

/// Ends them all. @pre root has not been reaped
void kill_tree(pid_t root);

}  // namespace contactcheck::process
