// A process and all that it has started.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace contactcheck::process {

/// `root` and its descendants, as far as the kernel knows (children of an ended process no longer
/// count as its descendants).
std::vector<pid_t> process_tree(pid_t root);

/// The name of a running process that a child of this one has started, which leads a process group,
/// and that has left this group: no signal to it reaches it. "" where there is none.
std::string descendant_outside_its_group();

/// The resident memory of a process and its descendants, bytes; shared pages count once for each.
std::uint64_t resident_bytes_of_tree(pid_t root);

/// Kills the whole tree. @pre root has not been reaped
void kill_tree(pid_t root);

/// From now on orphans among this process's descendants become its children, wherever they have
/// gone: into a session or a group of their own, with an environment of their own
/// (PR_SET_CHILD_SUBREAPER). A system call and nothing else: also for use between fork and exec.
void adopt_orphans();

/// A child of this process, whose descendants end with it. This process adopts orphans from the
/// first on; where the child does so too, its own stay with it until its end, and can be told from
/// those of other children. For one thread.
class Child {
 public:
  Child();
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void started(pid_t pid) { pid_ = pid; }
  pid_t pid() const { return pid_; }
  /// Ends and reaps every child of this process but those that it had when this was made and those
  /// of other Child objects. @pre the child itself has been reaped
  void end_orphans() const;

 private:
  pid_t pid_ = 0;
  std::vector<pid_t> before_;  ///< children that there were, sorted
};

}  // namespace contactcheck::process
