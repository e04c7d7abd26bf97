#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::Outcome;
using testing::HasSubstr;

class DiffCommand : public testing::Test {
 protected:
  std::string write(const std::string& name, const Json& results) {
    return scratch_.write(name, results.dump()).string();
  }

  test::Scratch scratch_;
  Json results_ = Json::parse(test::text_of(CONTACTCHECK_EXAMPLE_RESULTS));
};

TEST_F(DiffCommand, OfAFileWithItselfSaysSo) {
  const std::string file = write("a.json", results_);
  const Outcome outcome = contactcheck_program({"diff", file, file});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "before  " + file + "  version 0.1.0, 4 rows\nafter   " + file +
                "  version 0.1.0, 4 rows\n\n"
                "4 of 4 common rows have the same answers; 0 differ clearly in time.\n");
}

TEST_F(DiffCommand, NamesWhatIsWorseAndInformsWithExitCodeZero) {
  const std::string before = write("a.json", results_);
  Json& body = results_["runs"][0]["levels"]["body"];
  body["spurious"] = 2;
  results_["runs"].erase(3);
  const Outcome outcome = contactcheck_program({"diff", before, write("b.json", results_)});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out,
              HasSubstr("Worse (1)\n  hello  ffd-aabb-sphere2  body spurious 1 -> 2\n"));
  EXPECT_THAT(outcome.out, HasSubstr("Gone (1)\n"));
}

TEST_F(DiffCommand, FailsWhereAnAnswerIsWorseOrARowIsGone) {
  const std::string before = write("a.json", results_);
  const auto code = [&](const Json& after) {
    return contactcheck_program({"diff", "--fail", before, write("b.json", after)}).exit_code;
  };
  EXPECT_EQ(code(results_), 0);
  Json worse = results_, gone = results_;
  worse["runs"][0]["levels"]["body"]["spurious"] = 2;
  EXPECT_EQ(code(worse), 1);
  gone["runs"].erase(3);
  EXPECT_EQ(code(gone), 1);
  const std::string bad = write("worse.json", worse);
  EXPECT_EQ(contactcheck_program({"diff", "--fail", bad, before}).exit_code, 0) << "better";
}

TEST_F(DiffCommand, RefusesAFileThatIsNotCompleteByItsName) {
  const std::string whole = write("whole.json", results_);
  results_["runs"][0].erase("geometry");
  const std::string cut = write("cut.json", results_);
  for (const auto& [a, b] : {std::pair(whole, cut), std::pair(cut, whole)}) {
    const Outcome outcome = contactcheck_program({"diff", a, b});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(cut + ": not complete: runs[0]"));
    EXPECT_THAT(outcome.err, HasSubstr("geometry"));
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_THAT(contactcheck_program({"diff", whole, "/nonexistent.json"}).err,
              HasSubstr("/nonexistent.json"));
  EXPECT_EQ(contactcheck_program({"diff", whole}).exit_code, 2);
}

}  // namespace
}  // namespace contactcheck::cli
