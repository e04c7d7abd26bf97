// The words of the command line as data, from which pages and scripts are generated.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/detect/registry.h"

namespace CLI {
class App;
class FormatterBase;
}  // namespace CLI

namespace contactcheck::cli {

struct OptionWords {
  std::vector<std::string> flags;  ///< with their dashes; a positional has its name only
  std::string value;               ///< what follows ("DIR"); empty: nothing
  std::string help;
  bool positional = false, required = false;
};

struct CommandWords {
  std::string name;     ///< empty for the program itself
  std::string summary;  ///< one line
  std::string footer;   ///< sentences, then examples: lines that begin with two blanks
  std::vector<OptionWords> options;
};

struct ProgramWords {
  std::string name, version;
  CommandWords own;
  std::vector<CommandWords> commands;  ///< without those that no help names
};

ProgramWords words_of(const CLI::App& app);
/// The words of the program with the detectors of `catalog`, which its help names.
ProgramWords program_words(const DetectorCatalog& catalog);

/// A formatter with one line per option, in the same words.
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace contactcheck::cli
