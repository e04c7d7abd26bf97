#include "reference/cli/command_words.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "reference/cli/arguments.h"
#include "reference/cli/wrapped_text.h"

namespace contactcheck::cli {
namespace {

constexpr std::size_t kHelpColumn = 27, kHelpWidth = 100;

// CLI11 says "UINT:INT in [1 - 100]" where a reader wants "N" and "(1 to 100)".
void split_range(OptionWords& words) {
  const std::size_t open = words.value.find(" in ["), dash = words.value.find(" - ");
  if (open != std::string::npos && dash != std::string::npos) {
    const std::string low = words.value.substr(open + 5, dash - open - 5);
    const std::string high = words.value.substr(dash + 3, words.value.size() - dash - 4);
    words.help += " (" + low + " to " + high + ")";
  }
  words.value = words.value.substr(0, words.value.find(':'));
  if (words.value == "UINT" || words.value == "INT") words.value = "N";
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  words.positional = option.get_positional();
  words.required = option.get_required();
  words.help = option.get_description();
  if (words.positional) words.flags.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) words.flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.flags.push_back("--" + name);
  if (option.get_items_expected_max() > 0 && !words.positional)
    words.value = option.get_type_name();
  split_range(words);
  return words;
}

class OneLineAnOption : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool) const override {
    const OptionWords words = words_of(*option);
    std::string left;
    for (const std::string& flag : words.flags) left += (left.empty() ? "" : ",") + flag;
    if (!words.value.empty()) left += " " + words.value;
    return fmt::format("  {:<{}}", left, kHelpColumn - 2) +
           wrapped_text(words.help, kHelpColumn, kHelpWidth);
  }
};

CommandWords command_words(const CLI::App& app) {
  CommandWords words{app.get_name(), app.get_description(), app.get_footer(), {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) words.options.push_back(words_of(*option));
  return words;
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  auto formatter = std::make_shared<OneLineAnOption>();
  formatter->column_width(kHelpColumn);
  return formatter;
}

ProgramWords words_of(const CLI::App& app) {
  ProgramWords words;
  words.name = app.get_name();
  words.version = app.version();
  words.own = command_words(app);
  words.own.name.clear();
  for (const CLI::App* command : app.get_subcommands({}))
    if (!command->get_group().empty()) words.commands.push_back(command_words(*command));
  return words;
}

ProgramWords program_words(const DetectorCatalog& catalog) {
  CLI::App app;
  CommandLine line{app, catalog, "", {}};
  describe_program(line);
  return words_of(app);
}

}  // namespace contactcheck::cli
