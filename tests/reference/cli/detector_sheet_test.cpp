#include "reference/cli/detector_sheet.h"

#include <gmock/gmock.h>

#include <sstream>

#include "core/detect/option_info.h"
#include "core/detect/registry.h"
#include "reference/adapters/register.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

class Declaring : public Detector {
 public:
  explicit Declaring(Semantics semantics) : semantics_(std::move(semantics)) {}
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return false; }
  void prepare(const std::vector<Body>&) override {}
  void update(const Frame&) override {}
  void query(Question, ContactSet&) override {}

 private:
  Semantics semantics_;
};

DetectorInfo info_with(const Semantics& semantics) {
  DetectorInfo info;
  info.id = "some-detector";
  info.summary = "finds something";
  info.make = [semantics](const Options&) { return std::make_unique<Declaring>(semantics); };
  return info;
}

Semantics plain() {
  Semantics s;
  s.levels = {Level::kBody, Level::kTriangle};
  s.questions = {Question::kTriangles, Question::kBody};
  s.exact = true;
  return s;
}

TEST(DetectorSheet, OfAnExactDetector) {
  EXPECT_EQ(detector_sheet(info_with(plain()), 100),
            "some-detector\n"
            "  finds something\n"
            "  claims      body, triangle; exact: nothing missed, nothing spurious\n"
            "  questions   triangles, body\n"
            "  contact     of surfaces; touching counts\n"
            "  numbers     double precision\n"
            "  depth       none\n");
}

TEST(DetectorSheet, OfOneThatSpeaksInMargins) {
  Semantics s;
  s.levels = {Level::kNear};
  s.informative = {Level::kVertex, Level::kBody};
  s.questions = {Question::kContacts};
  s.solid = true;
  s.closed = false;
  s.margin = 0.002;
  s.precision = Precision::kSingle;
  s.scale = 40.0;
  s.depth = DepthKind::kVertexSurface;
  s.means = "a vertex nearer than the sum of both margins";
  EXPECT_EQ(detector_sheet(info_with(s), 100),
            "some-detector\n"
            "  finds something\n"
            "  claims      near\n"
            "  informative vertex, body\n"
            "  questions   contacts\n"
            "  contact     of solids: one inside another is in contact; touching does not count; "
            "margin 0.002 m,\n"
            "              strictly nearer\n"
            "  means       a vertex nearer than the sum of both margins\n"
            "  numbers     single precision, given at scale 40\n"
            "  depth       vertex-surface\n");
}

TEST(DetectorSheet, SaysThatSinglePrecisionHasALocalOrigin) {
  Semantics s;
  s.levels = {Level::kBody};
  s.questions = {Question::kBody};
  s.precision = Precision::kSingle;
  s.local_origin = true;
  EXPECT_NE(
      detector_sheet(info_with(s), 100).find("numbers     single precision about a local origin\n"),
      std::string::npos);
}

TEST(DetectorSheet, SaysWhatTheDetectorIsGivenAndThatNothingEndsEarly) {
  Semantics s = plain();
  s.questions = {Question::kContacts, Question::kBody};
  s.no_early_end = true;
  DetectorInfo info = info_with(s);
  info.given = "a sweep";
  EXPECT_THAT(
      detector_sheet(info, 100),
      AllOf(HasSubstr("  questions   contacts, body; body without an early end: no speed-up "
                      "over it\n"),
            HasSubstr("  given       a sweep\n")));
}

TEST(DetectorSheet, OptionsShowDefaultAndWhatIsAllowed) {
  DetectorInfo info = info_with(plain());
  info.options = {choice_option("bounds", "safe", {"paper", "safe"}, "how culling is bounded"),
                  numeric_option("k", "8", 1, 64, true, "clusters per body"),
                  numeric_option("margin", "0.001", 0, 0.5, false, "metres")};
  EXPECT_THAT(detector_sheet(info, 100),
              HasSubstr("  options     bounds=safe (paper|safe): how culling is bounded\n"
                        "              k=8 (1 to 64, whole): clusters per body\n"
                        "              margin=0.001 (0 to 0.5): metres\n"));
}

TEST(DetectorSheet, DefaultsReachTheDetector) {
  DetectorInfo info = info_with(plain());
  info.options = {numeric_option("margin", "0.25", 0, 1, false, "metres")};
  info.make = [](const Options& options) {
    Semantics s = plain();
    s.margin = number_option(options, "margin");
    return std::make_unique<Declaring>(s);
  };
  EXPECT_THAT(detector_sheet(info, 100), HasSubstr("margin 0.25 m, strictly nearer"));
}

TEST(DetectorSheet, ShowsTheOptionsThatWereGiven) {
  DetectorCatalog catalog;
  DetectorInfo info = info_with(plain());
  info.options = {numeric_option("margin", "0.25", 0, 1, false, "metres"),
                  numeric_option("k", "8", 1, 64, true, "clusters")};
  info.make = [](const Options& options) {
    Semantics s = plain();
    s.margin = number_option(options, "margin");
    return std::make_unique<Declaring>(s);
  };
  catalog.add(info);
  const std::string sheet =
      detector_sheet(info, catalog.parse("some-detector:margin=0.5,k=8"), 100);
  EXPECT_THAT(sheet, testing::StartsWith("some-detector:margin=0.5\n  finds something\n"));
  EXPECT_THAT(sheet, HasSubstr("margin 0.5 m, strictly nearer"));
  EXPECT_THAT(sheet, HasSubstr("  options     margin=0.5 (0 to 1; default 0.25): metres\n"
                               "              k=8 (1 to 64, whole): clusters\n"));
}

TEST(DetectorSheet, OfAnAbsentOneSaysWhyAndMakesNone) {
  DetectorInfo info;
  info.id = "elsewhere";
  info.summary = "is not here";
  info.absent_because = "built without its library";
  const std::string sheet = detector_sheet(info, 100);
  EXPECT_THAT(sheet, HasSubstr("  absent      built without its library\n"));
  EXPECT_THAT(sheet, Not(HasSubstr("claims")));
}

TEST(DetectorSheet, KeepsTheFileOrCommandInOneLineHoweverLongItIs) {
  plugin::Plugin plugin;
  plugin.declaration.semantics = plain();
  const DetectorSpec spec = {"mine", {}, "mine"};
  for (const std::string& path :
       {std::string("/srv/two  blanks/libmine.so"), "/" + std::string(200, 'n') + "/libmine.so"}) {
    plugin.source = {plugin::PluginKind::kLibrary, path};
    EXPECT_THAT(plugin_sheet(plugin, info_with(plain()).options, spec, 30),
                HasSubstr("\n  from        library \"" + path + "\"\n"));
    plugin.source = {plugin::PluginKind::kCommand, "python3 '" + path + "'"};
    EXPECT_THAT(plugin_sheet(plugin, info_with(plain()).options, spec, 30),
                HasSubstr("\n  from        command \"python3 '" + path + "'\"\n"));
  }
}

// With runs of blanks and line ends as one blank, so that it does not matter where lines break.
std::string on_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string out;
  for (std::string word; words >> word;) out += word + " ";
  return out;
}

// help_test.py holds what `list` prints against the same file.
TEST(DetectorSheet, IsKeptForEveryDetectorOfTheCatalogue) {
  std::string ids;
  const DetectorCatalog catalog = adapters::standard_catalog();
  for (const DetectorInfo& info : catalog.all()) ids += info.id + "\n";
  EXPECT_EQ(ids, test::text_of(CONTACTCHECK_DETECTORS));
}

TEST(DetectorSheet, OfEveryDetectorGivesSummaryAndOptionsWithinAHundredColumns) {
  const DetectorCatalog catalog = adapters::standard_catalog();
  for (const DetectorInfo& info : catalog.all()) {
    const std::string sheet = detector_sheet(info, 100), text = on_one_line(sheet);
    EXPECT_THAT(sheet, testing::StartsWith(info.id + "\n"));
    EXPECT_FALSE(info.summary.empty()) << info.id;
    EXPECT_THAT(text, HasSubstr(on_one_line(info.summary)));
    for (const OptionInfo& o : info.options) {
      EXPECT_THAT(text, HasSubstr(o.name + "=" + o.default_value + " ("));
      EXPECT_THAT(text, HasSubstr(on_one_line(o.help)));
    }
    std::istringstream lines(sheet);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(DetectorSheet, BreaksLongLinesBetweenWords) {
  DetectorInfo info = info_with(plain());
  info.summary = "one two three four five six seven";
  EXPECT_THAT(detector_sheet(info, 20), HasSubstr("\n  one two three four\n  five six seven\n"));
}

}  // namespace
}  // namespace contactcheck::cli
