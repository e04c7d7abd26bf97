#include <gmock/gmock.h>

#include "core/detect/registry.h"
#include "reference/adapters/register.h"
#include "reference/scene/catalogue.h"
#include "tests/reference/cli/program.h"

namespace contactcheck {
namespace {

using test::contactcheck_program;
using test::Outcome;
using testing::HasSubstr;

TEST(List, NamesEverySuiteSceneAndDetectorWithItsLine) {
  const Outcome list = contactcheck_program({"list"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_EQ(list.err, "");
  for (const auto& entries :
       {list_suites(CONTACTCHECK_FIXTURES), list_scenes(CONTACTCHECK_FIXTURES)}) {
    EXPECT_FALSE(entries.empty());
    for (const CatalogueEntry& e : entries) {
      EXPECT_THAT(list.out, HasSubstr("\n  " + e.id + " "));
      EXPECT_THAT(list.out, HasSubstr(e.title));
    }
  }
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  register_reference_detectors(catalog);
  for (const DetectorInfo& info : catalog.all()) {
    EXPECT_THAT(list.out, HasSubstr("\n  " + info.id + " "));
    EXPECT_THAT(list.out, HasSubstr(info.summary));
    for (const OptionInfo& o : info.options)
      EXPECT_THAT(list.out, HasSubstr(":" + o.name + "=" + o.default_value));
  }
}

TEST(Help, IsThereForEveryCommandWithAnExample) {
  for (const std::string command : {"", "run", "list", "report"}) {
    std::vector<std::string> arguments = {"--help"};
    if (!command.empty()) arguments.insert(arguments.begin(), command);
    const Outcome help = contactcheck_program(arguments);
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(help.err, "") << command;
    EXPECT_THAT(help.out, HasSubstr("Example")) << command;
    EXPECT_THAT(help.out, HasSubstr("\n  contactcheck ")) << command;
  }
}

TEST(Help, OfRunNamesItsFlags) {
  const Outcome help = contactcheck_program({"run", "--help"});
  for (const char* flag :
       {"--detector", "--frames", "--repeat", "--processes", "--out", "--quiet", "--no-timing"})
    EXPECT_THAT(help.out, HasSubstr(flag));
}

TEST(Help, DoesNotShowTheWorkersCommand) {
  EXPECT_THAT(contactcheck_program({"--help"}).out, testing::Not(HasSubstr("worker")));
}

TEST(Version, IsPrinted) {
  const Outcome version = contactcheck_program({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace
}  // namespace contactcheck
