// What the program's exit codes mean, in every command and in workers.
#pragma once

namespace contactcheck::process {

/// A check said no: `gate`, `ab`, `diff` and `tune`; `check` and `defects` return 1, too.
inline constexpr int kExitNo = 1;
/// Bad usage or bad input; one sentence says what.
inline constexpr int kExitBadInput = 2;
/// A detector ended in an error that fixtures/hard/known-defects.json does not list.
inline constexpr int kExitUnlistedError = 3;
/// A fault of the program itself.
inline constexpr int kExitInternal = 70;

}  // namespace contactcheck::process
