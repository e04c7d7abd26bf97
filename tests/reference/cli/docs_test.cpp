// The manual page and completions say what --help says: nothing is left out, nothing runs into the
// markup.
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "reference/adapters/register.h"
#include "reference/cli/command_words.h"
#include "reference/cli/completion.h"
#include "reference/cli/man_page.h"

namespace contactcheck::cli {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

struct Bound {
  int count = 0;
  std::string file, detector;
};

ProgramWords small_program(Bound& bound) {
  CLI::App app("Tries things.");
  app.name("tool");
  CLI::App* go = app.add_subcommand("go", "it's a [try]: go");
  go->add_option("-n,--count", bound.count, "how often")->check(CLI::Range(1, 9));
  go->add_option("targets", bound.file, "what")->required();
  go->footer("It ends.\nExample:\n  tool go .hidden\\x");
  app.add_subcommand("inner", "")->group("");
  return words_of(app);
}

ProgramWords real_program() { return program_words(adapters::standard_catalog()); }

TEST(CommandWords, AreThoseOfTheCommandLine) {
  Bound bound;
  const ProgramWords program = small_program(bound);
  ASSERT_EQ(program.commands.size(), 1u) << "what no help names is left out";
  const std::vector<OptionWords>& options = program.commands[0].options;
  ASSERT_EQ(options.size(), 3u);
  EXPECT_THAT(options[1].flags, ElementsAre("-n", "--count"));
  EXPECT_EQ(options[1].value, "N");
  EXPECT_EQ(options[1].help, "how often (1 to 9)");
  EXPECT_TRUE(options[2].positional && options[2].required);
  EXPECT_THAT(options[2].flags, ElementsAre("targets"));
}

TEST(ManPage, EscapesWhatTroffWouldRead) {
  Bound bound;
  const std::string page = man_page(small_program(bound));
  EXPECT_THAT(page, AllOf(HasSubstr(".TP\n\\fB\\-n\\fR, \\fB\\-\\-count\\fR \\fIN\\fR\nhow often"),
                          HasSubstr("\ntool go .hidden\\ex\n"), HasSubstr("\nIt ends.\n")));
}

TEST(ManPage, NamesEveryFlagOfTheProgram) {
  const ProgramWords program = real_program();
  const std::string page = man_page(program);
  ASSERT_GE(program.commands.size(), 12u);
  for (const CommandWords& command : program.commands) {
    const std::size_t heading = page.find(".SS \\fBcontactcheck\\fR \\fB" + command.name + "\\fR");
    ASSERT_NE(heading, std::string::npos) << command.name;
    const std::string section = page.substr(heading, page.find("\n.S", heading + 1) - heading);
    for (const OptionWords& option : command.options)
      if (!option.positional && option.flags.back() != "--help") {
        std::string flag = option.flags.back();
        for (std::size_t at = 0; (at = flag.find('-', at)) != std::string::npos; at += 2)
          flag.insert(at, "\\");
        EXPECT_THAT(section, HasSubstr("\\fB" + flag + "\\fR")) << command.name;
      }
  }
}

TEST(Completion, OffersWhatCanFollow) {
  OptionWords option;
  const auto kind = [&](const char* flag, const char* value) {
    option.flags = {flag};
    option.value = value;
    return kind_of(option);
  };
  EXPECT_EQ(kind("--detector", "TEXT"), ValueKind::kDetectors);
  EXPECT_EQ(kind("--out", "TEXT"), ValueKind::kFile);
  EXPECT_EQ(kind("--frames", "N"), ValueKind::kWord);
  EXPECT_EQ(kind("--quiet", ""), ValueKind::kNothing);
  EXPECT_EQ(names_command(ValueKind::kFile, "contactcheck"), "");
}

TEST(Completion, QuotesHelpForEveryShell) {
  Bound bound;
  const ProgramWords program = small_program(bound);
  EXPECT_THAT(zsh_completion(program), HasSubstr("'go:it\u2019s a (try), go'"));
  EXPECT_THAT(fish_completion(program),
              AllOf(HasSubstr("-s n -l count -x -d 'how often (1 to 9)'"), Not(HasSubstr("it's"))));
}

}  // namespace
}  // namespace contactcheck::cli
