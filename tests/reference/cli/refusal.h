// What every refusal has in common: exit code 2, one sentence on stderr, nothing on stdout and
// nothing written.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "tests/reference/cli/program.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

using Words = std::vector<std::string>;

/// A command line that must be refused. In words and pieces, DIR stands for a folder of the test's
/// own, which holds a good scene, DIR/tiny.json, and whatever else the test has put there.
struct BadCommand {
  std::string name;  ///< of the test
  Words words;       ///< without the program
  Words named;       ///< pieces of the sentence: file, place, value, what is allowed
};
void PrintTo(const BadCommand& command, std::ostream* out);

/// `text` with every DIR replaced.
std::string with_folder(std::string text, const Scratch& scratch);

/// Runs the command; every file and folder below DIR must be there afterwards as it was before.
void expect_refused(const BadCommand& command, const Scratch& scratch);

}  // namespace contactcheck::test
