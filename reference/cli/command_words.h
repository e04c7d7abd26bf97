// The words of the command line as data, for pages and scripts that must not be written twice.
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
  std::vector<std::string> flags;  ///< with their dashes; of a positional its name alone
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
/// Of the program as it is with the detectors of `catalog`, which its help names.
ProgramWords program_words(const DetectorCatalog& catalog);

/// Help with one line an option, in the same words.
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace contactcheck::cli
