// The three kinds of checks of this code base.
//
//   InputError, RefusedInput: the user's data is bad; a sentence names place and value
//   CONTACTCHECK_INVARIANT: a promise of our own code is broken; aborts in every build
//   CONTACTCHECK_DCHECK: the same in hot loops; Debug builds only
#pragma once

#include <stdexcept>
#include <string>

namespace contactcheck {

/// Bad input from outside (file, flag, scene, mesh). The message is one sentence for the user.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Input that a detector must not answer, such as a NaN vertex: the run's status becomes `refused`.
class RefusedInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A requirement that this machine does not meet: the run's status becomes `absent`.
class Unavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[noreturn]] void invariant_failed(const char* expression, const char* file, int line,
                                   const std::string& message);

}  // namespace contactcheck

#define CONTACTCHECK_INVARIANT(condition, message)                                               \
  do {                                                                                           \
    if (!(condition)) ::contactcheck::invariant_failed(#condition, __FILE__, __LINE__, message); \
  } while (false)

#ifdef NDEBUG
#define CONTACTCHECK_DCHECK(condition) ((void)0)
#else
#define CONTACTCHECK_DCHECK(condition) CONTACTCHECK_INVARIANT(condition, "")
#endif
