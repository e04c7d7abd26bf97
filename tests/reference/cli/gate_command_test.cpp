// contactcheck gate and accept as a whole program.
#include <gmock/gmock.h>

#include "tests/reference/cli/gate_files.h"
#include "tests/reference/cli/program.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::Environment;
using test::Outcome;
using test::row_of;
using test::sample_results;
using test::text_of;
using testing::HasSubstr;
using testing::StartsWith;

class GateCommand : public testing::Test {
 protected:
  GateCommand() { test::write_gate_files(scratch_); }

  Outcome gate(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"gate",       path("results.json"),
                                      "--policy",   path("policy.json"),
                                      "--baseline", path("baseline.json")};
    words.insert(words.end(), more.begin(), more.end());
    return contactcheck_program(words);
  }
  Outcome gate_of(const Json& results) const {
    scratch_.write("results.json", results.dump());
    return gate();
  }
  std::string path(const std::string& name) const { return (scratch_.folder() / name).string(); }

  test::Scratch scratch_;
};

TEST_F(GateCommand, OfTheSameResultsIsGreen) {
  const Outcome outcome = gate();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out,
            "own  Of a test\n"
            "6 checks of 4 rules: 6 pass, 0 fail, 0 too noisy to judge, 0 cannot judge\n"
            "gate: green\n");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(GateCommand, PolicyMayBeTheNameOfOneThatComesAlong) {
  const Outcome named = contactcheck_program(
      {"gate", path("results.json"), "--policy", "unchanged", "--baseline", path("baseline.json")});
  const Outcome without =
      contactcheck_program({"gate", path("results.json"), "--baseline", path("baseline.json")});
  EXPECT_EQ(named.exit_code, without.exit_code);
  EXPECT_EQ(named.out, without.out);
  const Outcome wrong = contactcheck_program({"gate", path("results.json"), "--policy", "defualt"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, StartsWith("contactcheck: there is no policy \"defualt\"; did you mean "
                                    "default? there are "));
}

TEST_F(GateCommand, OneInjectedMissedContactIsRed) {
  Json results = sample_results();
  Json& row = row_of(results, "touch", "exact");
  row["levels"]["triangle"]["missed"] = 1;
  row["per_frame"]["missed"][4] = 1;
  const Outcome outcome = gate_of(results);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out,
              HasSubstr("FAIL  none missed\n"
                        "  touch  exact: missed 1 at level triangle, allowed at most 0, frame 4\n"
                        "    contactcheck run scenes/touch.json --frames 8 --detector exact "
                        "--no-timing\n"));
  EXPECT_THAT(outcome.out, HasSubstr(" 1 fail,"));
}

TEST_F(GateCommand, OneInjectedSpuriousContactIsRed) {
  Json results = sample_results();
  row_of(results, "touch", "exact")["levels"]["triangle"]["spurious"] = 1;
  row_of(results, "touch", "exact")["per_frame"]["spurious"][7] = 1;
  const Outcome outcome = gate_of(results);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("FAIL  none spurious\n  touch  exact: spurious 1 at level "
                                     "triangle, allowed at most 0, frame 7\n"));
}

TEST_F(GateCommand, ThirtyPercentSlowerIsRed) {
  Json results = sample_results();
  for (const char* key : {"ratio", "low", "high"}) {
    Json& value = row_of(results, "touch", "exact")["speedup"]["triangles"]["ref"]["playback"][key];
    value = value.get<double>() / 1.3;
  }
  const Outcome outcome = gate_of(results);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("FAIL  as fast as it was\n  touch  exact: slowdown 1.30x ["));
}

TEST_F(GateCommand, MissingSceneIsRed) {
  Json results = sample_results();
  results["scenes"].erase(1);
  results["runs"].erase(6);
  const Outcome outcome = gate_of(results);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("hard-gap: the baseline has this scene, the results do not"));
}

TEST_F(GateCommand, ChangedContactHashIsRed) {
  Json results = sample_results();
  row_of(results, "touch", "exact")["contact_hash"] = "0xff";
  const Outcome outcome = gate_of(results);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out,
              HasSubstr("contact_hash 0xff, allowed 0xa, that of the baseline; the truth is as it "
                        "was: the detector's answer changed\n"));
}

TEST_F(GateCommand, WithABaselineAloneAllowsNoOtherAnswer) {
  const std::vector<std::string> words = {"gate", path("results.json"), "--baseline",
                                          path("baseline.json")};
  const Outcome same = contactcheck_program(words);
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_THAT(same.out, StartsWith("unchanged  contacts, errors of depths"));
  Json results = sample_results();
  row_of(results, "touch", "paper")["levels"]["cell"]["missed"] = 4;
  scratch_.write("results.json", results.dump());
  const Outcome other = contactcheck_program(words);
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.out, HasSubstr("FAIL  missed contacts unchanged\n"
                                   "  touch  paper: missed 4 at level cell, allowed 3"));
}

TEST_F(GateCommand, WritesXmlThatAParserReads) {
  Json results = sample_results();
  const std::string nasty = "<exact> & \"co\"\x01\xc3\xa4'";
  row_of(results, "touch", "exact")["detector"] = nasty;
  scratch_.write("results.json", results.dump());
  const Outcome outcome = gate({"--junit", path("gate.xml")});
  EXPECT_EQ(outcome.exit_code, 1);
  const Outcome parsed = test::run_program(
      CONTACTCHECK_PYTHON3,
      {"-c",
       "import sys, xml.etree.ElementTree as e\n"
       "root = e.parse(sys.argv[1]).getroot()\n"
       "cases = list(root.iter('testcase'))\n"
       "failed = [c for c in cases if c.find('failure') is not None]\n"
       "print(root.get('tests'), len(cases), root.get('failures'), len(failed))\n"
       "print(ascii(sorted({c.get('name') for c in cases if '<' in c.get('name')})))\n"
       "print([c.get('time') for c in cases if c.get('time')])\n",
       path("gate.xml")});
  EXPECT_EQ(parsed.exit_code, 0) << parsed.err;
  // Three rules want "exact" in "touch" and match nothing, the fourth has two other scenes; the
  // baseline's row is gone, and the new one is covered by no rule.
  EXPECT_EQ(parsed.out, "6 6 4 4\n[]\n[]\n");
}

TEST_F(GateCommand, WritesNamesThatNeedEscapesIntoXml) {
  Json results = sample_results();
  row_of(results, "touch", "exact")["detector"] = "<e> & \"co\"\xc3\xa4'";
  scratch_.write("results.json", results.dump());
  scratch_.write("policy.json", test::policy_text(R"({"rule": "<R> & \"S\"", "scenes": ["touch"],
                     "detectors": ["<e>*"], "measure": "missed", "at_most": 0})"));
  const Outcome outcome = contactcheck_program(
      {"gate", path("results.json"), "--policy", path("policy.json"), "--junit", path("gate.xml")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Outcome parsed = test::run_program(
      CONTACTCHECK_PYTHON3, {"-c",
                             "import sys, xml.etree.ElementTree as e\n"
                             "case, = e.parse(sys.argv[1]).getroot().iter('testcase')\n"
                             "print(ascii(case.attrib))\n",
                             path("gate.xml")});
  EXPECT_EQ(parsed.out, "{'classname': '<R> & \"S\"', 'name': 'touch <e> & \"co\"\\xe4\\''}\n")
      << parsed.err;
}

TEST_F(GateCommand, AnnotatesForGithubAndAppendsToItsSummary) {
  Json results = sample_results();
  row_of(results, "touch", "exact")["levels"]["triangle"]["missed"] = 1;
  scratch_.write("results.json", results.dump());
  scratch_.write("summary.md", "before\n");
  const Environment environment("GITHUB_STEP_SUMMARY", path("summary.md"));
  const Outcome outcome = gate({"--github"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("\n::error title=none missed::touch  exact: missed 1 at level "
                                     "triangle, allowed at most 0%0Acontactcheck run"));
  EXPECT_THAT(text_of(scratch_.folder() / "summary.md"),
              StartsWith("before\n## contactcheck gate own: red\n"));
  EXPECT_THAT(gate().out, testing::Not(HasSubstr("::error"))) << "unless asked for";
}

TEST_F(GateCommand, AnnotatesWhereGithubGivesNoSummary) {
  const Environment environment("GITHUB_STEP_SUMMARY", "");
  EXPECT_EQ(gate({"--github"}).exit_code, 0);
}

class AcceptCommand : public testing::Test {
 protected:
  Outcome run() const {
    return contactcheck_program({"run", scratch_.write("tiny.json", test::tiny_scene()).string(),
                                 "--quiet", "--processes", "1", "--detector", "fcl-aabb",
                                 "--detector", "ffd-aabb", "--detector", "ffd-lazy", "--out",
                                 path("out")});
  }
  Outcome accept(const std::string& as = "base.json") const {
    return contactcheck_program({"accept", path("out/results.json"), "--as", path(as)});
  }
  std::string path(const std::string& name) const { return (scratch_.folder() / name).string(); }

  test::Scratch scratch_;
};

TEST_F(AcceptCommand, WritesABaselineThatIsValidAndThatAnotherRunPasses) {
  ASSERT_EQ(run().exit_code, 0);
  const Outcome accepted = accept();
  EXPECT_EQ(accepted.exit_code, 0) << accepted.err;
  EXPECT_THAT(accepted.out, StartsWith(path("base.json") + ": 3 rows of contactcheck run "));
  EXPECT_LT(fs::file_size(path("base.json")), fs::file_size(path("out/results.json")));
  const Outcome valid =
      test::run_program(CONTACTCHECK_PYTHON3, {"-B", CONTACTCHECK_VALIDATOR, path("base.json")});
  EXPECT_EQ(valid.exit_code, 0) << valid.out;
  ASSERT_EQ(run().exit_code, 0);
  scratch_.write("policy.json", test::policy_text(R"({"rule": "same", "scenes": ["*"],
      "detectors": ["*"], "measure": "contact_hash", "unchanged": true, "unjudged": "fail"})"));
  const Outcome gate = contactcheck_program({"gate", path("out/results.json"), "--policy",
                                             path("policy.json"), "--baseline", path("base.json")});
  EXPECT_EQ(gate.exit_code, 0) << gate.out << gate.err;
  EXPECT_THAT(gate.out, HasSubstr("3 checks of 1 rules: 3 pass"));
}

TEST_F(AcceptCommand, SaysWhatItChanges) {
  test::write_gate_files(scratch_);
  Json results = sample_results();
  const auto accept_results = [&] {
    scratch_.write("results.json", results.dump());
    return contactcheck_program({"accept", path("results.json"), "--as", path("baseline.json")});
  };
  EXPECT_THAT(accept_results().out, HasSubstr("8 rows of contactcheck run scenes/touch.json"));
  EXPECT_THAT(accept_results().out, HasSubstr("no row, count or contact changed\n"));
  row_of(results, "touch", "paper")["levels"]["cell"]["missed"] = 4;
  EXPECT_THAT(accept_results().out, HasSubstr("changed:\n  touch  paper: missed 3 -> 4\n"));
}

}  // namespace
}  // namespace contactcheck::cli
