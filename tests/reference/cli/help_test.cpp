#include <gmock/gmock.h>

#include <sstream>

#include "core/detect/registry.h"
#include "reference/adapters/register.h"
#include "reference/scene/catalogue.h"
#include "tests/reference/cli/program.h"

namespace contactcheck::cli {
namespace {

using test::contactcheck_program;
using test::Outcome;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(List, NamesEverySuiteSceneAndDetectorWithOneLine) {
  const Outcome list = contactcheck_program({"list"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_EQ(list.err, "");
  for (const auto& entries :
       {scene::list_suites(CONTACTCHECK_FIXTURES), scene::list_scenes(CONTACTCHECK_FIXTURES)}) {
    EXPECT_FALSE(entries.empty());
    for (const scene::CatalogueEntry& e : entries) {
      EXPECT_THAT(list.out, HasSubstr("\n  " + e.id + " "));
      EXPECT_THAT(list.out, HasSubstr(e.title));
    }
  }
  const DetectorCatalog catalog = adapters::standard_catalog();
  for (const DetectorInfo& info : catalog.all()) {
    EXPECT_THAT(list.out, HasSubstr("\n  " + info.id + " "));
    EXPECT_THAT(list.out, HasSubstr(info.summary + "\n"));
  }
  EXPECT_THAT(list.out, Not(HasSubstr("questions")));
}

// With runs of blanks and line ends as one blank, so that it does not matter where lines break.
std::string on_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string out;
  for (std::string word; words >> word;) out += word + " ";
  return out;
}

TEST(List, OfDetectorsGivesSemanticsAndOptionsWithinAHundredColumns) {
  const Outcome list = contactcheck_program({"list", "--detectors"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_EQ(list.err, "");
  EXPECT_THAT(list.out, testing::StartsWith("Detectors "));
  const std::string text = on_one_line(list.out);
  const DetectorCatalog catalog = adapters::standard_catalog();
  for (const DetectorInfo& info : catalog.all()) {
    EXPECT_THAT(list.out, HasSubstr("\n" + info.id + "\n"));
    EXPECT_THAT(text, HasSubstr(on_one_line(info.summary)));
    for (const OptionInfo& o : info.options) {
      EXPECT_THAT(text, HasSubstr(o.name + "=" + o.default_value + " ("));
      EXPECT_THAT(text, HasSubstr(on_one_line(o.help)));
    }
  }
  std::istringstream lines(list.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(List, GivesOnlyWhatIsAskedFor) {
  const std::string scenes = contactcheck_program({"list", "--scenes"}).out;
  EXPECT_THAT(scenes, AllOf(HasSubstr("Scenes\n"), HasSubstr("bunny-touch")));
  EXPECT_THAT(scenes, AllOf(Not(HasSubstr("Suites")), Not(HasSubstr("Detectors"))));
  const std::string suites = contactcheck_program({"list", "--suites"}).out;
  EXPECT_THAT(suites, AllOf(HasSubstr("Suites\n"), HasSubstr("default")));
  EXPECT_THAT(suites, AllOf(Not(HasSubstr("Scenes")), Not(HasSubstr("Detectors"))));
  EXPECT_EQ(contactcheck_program({"list", "--suites", "--scenes"}).out, suites + "\n" + scenes);
}

// "" is the program itself.
constexpr const char* kCommands[] = {"",       "run",   "reproduce", "reduce", "export", "list",
                                     "report", "truth", "defects",   "diff",   "gate",   "accept",
                                     "ab",     "tune",  "merge",     "init",   "check"};

Outcome help_of(const std::string& command) {
  std::vector<std::string> arguments = {"--help"};
  if (!command.empty()) arguments.insert(arguments.begin(), command);
  return contactcheck_program(arguments);
}

TEST(Help, IsThereForEveryCommandWithAnExample) {
  for (const char* command : kCommands) {
    const Outcome help = help_of(command);
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(help.err, "") << command;
    EXPECT_THAT(help.out, HasSubstr("Example")) << command;
    EXPECT_THAT(help.out, HasSubstr("\n  contactcheck ")) << command;
  }
}

TEST(Help, HasOneLineAnOptionWithinAHundredColumns) {
  for (const char* command : kCommands) {
    const std::string help = help_of(command).out;
    std::istringstream lines(help.substr(0, help.find("\nExample")));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 100u) << line;
      EXPECT_THAT(line, Not(testing::StartsWith("          "))) << "goes on";
    }
  }
}

TEST(Help, OfRunNamesItsFlags) {
  const Outcome help = contactcheck_program({"run", "--help"});
  for (const char* flag : {"--detector", "--frames", "--processes", "--seed", "--out", "--quiet",
                           "--no-timing", "--closed-loop", "--call-limit SECONDS",
                           "--memory-limit MIB", "--json-lines", "--shard K/N"})
    EXPECT_THAT(help.out, HasSubstr(flag));
}

TEST(Help, OfReproduceNamesItsFlagsAndItsFiles) {
  const Outcome help = contactcheck_program({"reproduce", "--help"});
  for (const char* word : {"--frames", "--repeat", "--out", "--quiet", "reproduction.md",
                           "reproduction.json", "suite paper"})
    EXPECT_THAT(on_one_line(help.out), HasSubstr(word));
  EXPECT_THAT(help.out, Not(HasSubstr("--closed-loop"))) << "it always is";
}

TEST(Help, OfExportNamesItsFlagsAndTheChecker) {
  const Outcome help = contactcheck_program({"export", "--help"});
  for (const char* word : {"--frames", "--every", "--out", "out/export", "check.py"})
    EXPECT_THAT(on_one_line(help.out), HasSubstr(word));
}

TEST(Help, DoesNotShowTheWorkersCommand) {
  EXPECT_THAT(contactcheck_program({"--help"}).out, Not(HasSubstr("worker")));
}

TEST(Version, IsPrinted) {
  const Outcome version = contactcheck_program({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace
}  // namespace contactcheck::cli
