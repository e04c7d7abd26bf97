// Flags and values that no command takes: unknown, out of range, twice, missing, contradictory.
#include <gmock/gmock.h>

#include "tests/reference/cli/refusal.h"
#include "tests/reference/cli/tiny_scene.h"

namespace contactcheck::cli {
namespace {

using test::BadCommand;
using test::Scratch;
using test::Words;

class BadFlag : public testing::TestWithParam<BadCommand> {};

TEST_P(BadFlag, IsRefusedWithOneSentence) {
  const Scratch scratch;
  scratch.write("tiny.json", test::tiny_scene());
  test::expect_refused(GetParam(), scratch);
}

std::string named_command(const testing::TestParamInfo<BadCommand>& test) {
  return test.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Program, BadFlag,
    testing::Values(
        BadCommand{"UnknownFlag", {"--verbose"}, {"unknown flag \"--verbose\""}},
        BadCommand{"FlagOfACommandBeforeIt", {"--frames", "3", "run"}, {"--frames"}},
        BadCommand{"NoFolder", {"init"}, {"folder", "contactcheck init --help"}},
        BadCommand{"EmptyWord", {""}, {"unknown command \"\""}},
        BadCommand{"CommandInCapitals", {"RUN"}, {"unknown command \"RUN\""}},
        BadCommand{"TwoCommands", {"list", "run", "--frames", "0"}, {"--frames", "0"}},
        BadCommand{"NotUtf8", {"run", "DIR/tiny.json", "--out", "DIR/\xff"}, {"word 4", "DIR/?"}},
        BadCommand{"ControlCharacters",
                   {"run", "DIR/tiny.json", "--detector", "fcl\naabb", "--out", "DIR/out"},
                   {"\"fcl aabb\""}}),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    List, BadFlag,
    testing::Values(BadCommand{"UnknownFlag", {"list", "--colour"}, {"--colour"}},
                    BadCommand{"Word", {"list", "scenes"}, {"scenes"}},
                    BadCommand{"ValueOfAFlag", {"list", "--scenes=some"}, {"--scenes", "some"}}),
    named_command);

// `words` behind "run DIR/tiny.json" and before "--out DIR/out".
BadCommand run_with(const std::string& name, const Words& words, const Words& named_command) {
  BadCommand command = {name, {"run", "DIR/tiny.json"}, named_command};
  command.words.insert(command.words.end(), words.begin(), words.end());
  command.words.insert(command.words.end(), {"--out", "DIR/out"});
  return command;
}

INSTANTIATE_TEST_SUITE_P(
    Shard, BadFlag,
    testing::Values(run_with("Empty", {"--shard", ""}, {"--shard \"\"", "2/3"}),
                    run_with("OneNumber", {"--shard", "2"}, {"--shard \"2\"", "K/N"}),
                    run_with("Zero", {"--shard", "0/2"}, {"--shard \"0/2\""}),
                    run_with("BeyondTheLast", {"--shard", "3/2"}, {"--shard \"3/2\""}),
                    run_with("Negative", {"--shard=-1/2"}, {"--shard \"-1/2\""}),
                    run_with("Words", {"--shard", "one/two"}, {"--shard \"one/two\""}),
                    run_with("NotANumber", {"--shard", "nan/nan"}, {"--shard \"nan/nan\""}),
                    run_with("Twice", {"--shard", "1/1", "--shard", "1/1"}, {"--shard"}),
                    run_with("WithoutAValue", {"--shard"}, {"--shard"}),
                    run_with("MoreThanScenes", {"--shard", "2/2"},
                             {"--shard 2/2", "this run has 1 scene,"}),
                    BadCommand{"OfReproduce", {"reproduce", "--shard", "1/1"}, {"--shard"}}),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Merge, BadFlag,
    testing::Values(BadCommand{"WithoutResults", {"merge"}, {"results"}},
                    BadCommand{"NoFile", {"merge", "DIR/none.json"}, {"DIR/none.json"}},
                    BadCommand{"Folder", {"merge", "DIR"}, {"DIR"}},
                    BadCommand{"AScene", {"merge", "DIR/tiny.json"}, {"DIR/tiny.json", "schema"}}),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Frames, BadFlag,
    testing::Values(run_with("Fraction", {"--frames", "1.5"}, {"--frames", "1.5"}),
                    run_with("Exponent", {"--frames", "1e3"}, {"--frames", "1e3"}),
                    run_with("WithAUnit", {"--frames", "3s"}, {"--frames", "3s"}),
                    run_with("NotANumber", {"--frames", "nan"}, {"--frames", "nan"}),
                    run_with("Empty", {"--frames", ""}, {"--frames"}),
                    run_with("EmptyBehindEquals", {"--frames="}, {"--frames"}),
                    run_with("AboveTheMost", {"--frames", "100001"}, {"--frames", "100001"}),
                    run_with("BeyondAllIntegers", {"--frames", "99999999999999999999999"},
                             {"--frames", "99999999999999999999999"}),
                    run_with("Twice", {"--frames", "3", "--frames", "4"}, {"--frames"})),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Counts, BadFlag,
    testing::Values(run_with("NegativeProcesses", {"--processes", "-1"}, {"--processes", "-1"}),
                    run_with("RepeatsThatAreGone", {"--repeat", "5"}, {"--repeat"}),
                    run_with("TooManyProcesses", {"--processes", "101"}, {"--processes", "101"}),
                    run_with("NoThreads", {"--threads", "0"}, {"--threads", "0"}),
                    run_with("NegativeThreads", {"--threads", "-2"}, {"--threads", "-2"}),
                    run_with("TooManyThreads", {"--threads", "257"}, {"--threads", "257"})),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Limits, BadFlag,
    testing::Values(
        run_with("NegativeSeconds", {"--call-limit", "-1"}, {"--call-limit", "-1"}),
        run_with("SecondsWithAUnit", {"--call-limit", "5s"}, {"--call-limit", "5s"}),
        run_with("EndlessSeconds", {"--call-limit", "inf"}, {"--call-limit", "inf"}),
        run_with("SecondsTwice", {"--call-limit", "5", "--call-limit", "6"}, {"--call-limit"}),
        run_with("HalfAMebibyte", {"--memory-limit", "64.5"}, {"--memory-limit", "64.5"}),
        run_with("MoreMemoryThanAddresses", {"--memory-limit", "99999999999999999999"},
                 {"--memory-limit", "99999999999999999999"})),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Detectors, BadFlag,
    testing::Values(
        run_with("Empty", {"--detector", ""}, {"unknown detector \"\"", "list"}),
        run_with("Capitals", {"--detector", "FCL-AABB"}, {"\"FCL-AABB\"", "list"}),
        run_with("TwoInOneWord", {"--detector", "fcl-aabb,embree"}, {"\"fcl-aabb,embree\""}),
        run_with("TriOfALibrary", {"--detector", "fcl-aabb+tri"}, {"\"fcl-aabb+tri\""}),
        run_with("ColonWithoutOption", {"--detector", "ffd-aabb:"}, {"\"ffd-aabb:\"", "option="}),
        run_with("OptionWithoutValue", {"--detector", "ffd-aabb:bounds"},
                 {"\"bounds\"", "option=value"}),
        run_with("EmptyValue", {"--detector", "ffd-aabb:bounds="}, {"bounds is \"\"", "paper"}),
        run_with("NoName", {"--detector", "ffd-aabb:=1"}, {"unknown option \"\""}),
        run_with("OptionTwice", {"--detector", "ffd-aabb:bounds=safe,bounds=safe"},
                 {"bounds is given twice"}),
        run_with("OptionOfAnother", {"--detector", "fcl-aabb:margin=1"},
                 {"unknown option \"margin\""}),
        run_with("NanValue", {"--detector", "bullet-vf:margin=nan"}, {"margin is \"nan\""}),
        run_with("InfiniteValue", {"--detector", "bullet-vf:margin=inf"}, {"margin is \"inf\""}),
        run_with("OverflowingValue", {"--detector", "bullet-vf:margin=1e999"},
                 {"margin is \"1e999\""}),
        run_with("HalfAThread", {"--detector", "ffd-lazy:threads=1.5"},
                 {"threads is \"1.5\"", "a whole number"})),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Run, BadFlag,
    testing::Values(
        run_with("UnknownInstructionSet", {"--detector", "ffd-lazy", "--isa", "MMX"},
                 {"isa is \"MMX\"", "AVX2"}),
        run_with("OneBadInstructionSet",
                 {"--detector", "ffd-lazy", "--isa", "best", "--isa", "avx2"}, {"\"avx2\""}),
        run_with("InstructionSetNobodyUses", {"--detector", "embree", "--isa", "best"},
                 {"--isa best", "no detector of this run"}),
        run_with("SingleDash", {"-frames", "3"}, {"-frames"}),
        run_with("OutTwice", {"--out", "DIR/other"}, {"--out"}),
        run_with("QuietWithAValue", {"--quiet=perhaps"}, {"--quiet", "perhaps"}),
        run_with("ResumeWithAValue", {"--resume", "DIR/other"}, {"\"DIR/other\""}),
        run_with("SceneTwice", {"DIR/./tiny.json"}, {"\"tiny\""}),
        BadCommand{"EmptyTarget", {"run", "", "--out", "DIR/out"}, {"\"\" is no suite"}},
        BadCommand{"EmptyOut", {"run", "DIR/tiny.json", "--out", ""}, {"--out"}},
        BadCommand{"OutWithoutAFolder", {"run", "DIR/tiny.json", "--out"}, {"--out"}}),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    RandomPairs, BadFlag,
    testing::Values(run_with("NoPairs", {"--pairs", "0"}, {"--pairs", "0"}),
                    run_with("NegativePairs", {"--pairs", "-5"}, {"--pairs", "-5"}),
                    run_with("TooManyPairs", {"--pairs", "100000001"}, {"--pairs", "100000001"}),
                    run_with("Exponent", {"--pairs", "1e6"}, {"--pairs", "1e6"}),
                    run_with("WithCommas", {"--pairs", "1,000"}, {"--pairs", "1,000"}),
                    run_with("Twice", {"--pairs", "5", "--pairs", "6"}, {"--pairs"}),
                    run_with("NegativeSeed", {"--pairs", "5", "--seed", "-1"}, {"--seed", "-1"}),
                    run_with("SeedThatIsNotWholeInEveryJson",
                             {"--pairs", "5", "--seed", "9007199254740992"},
                             {"--seed", "9007199254740992"}),
                    run_with("SeedThatIsAWord", {"--pairs", "5", "--seed", "x"}, {"--seed", "x"})),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Report, BadFlag,
    testing::Values(
        BadCommand{"NoFile", {"report"}, {"results"}},
        BadCommand{"TwoFiles", {"report", "a.json", "b.json"}, {"b.json"}},
        BadCommand{"EmptyFormat", {"report", "a.json", "--format", ""}, {"--format"}},
        BadCommand{"OneBadFormat", {"report", "a.json", "--format", "md,pdf"}, {"\"pdf\""}},
        BadCommand{"FormatInCapitals", {"report", "a.json", "--format", "MD"}, {"\"MD\"", "md"}},
        BadCommand{"FlagOfRun", {"report", "a.json", "--frames", "3"}, {"--frames"}}),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Export, BadFlag,
    testing::Values(BadCommand{"NoTarget", {"export", "--out", "DIR/out"}, {"targets"}},
                    BadCommand{"UnknownScene",
                               {"export", "bunny", "--out", "DIR/out"},
                               {"\"bunny\" is no suite", "did you mean", "bunny-touch"}},
                    BadCommand{"NoStep",
                               {"export", "DIR/tiny.json", "--every", "0", "--out", "DIR/out"},
                               {"--every", "0"}},
                    BadCommand{"HalfAStep",
                               {"export", "DIR/tiny.json", "--every", "1.5", "--out", "DIR/out"},
                               {"--every", "1.5"}},
                    BadCommand{
                        "TooManyFrames",
                        {"export", "DIR/tiny.json", "--frames", "100001", "--out", "DIR/out"},
                        {"--frames", "100001"}},
                    BadCommand{"FlagOfRun",
                               {"export", "DIR/tiny.json", "--repeat", "3", "--out", "DIR/out"},
                               {"--repeat"}},
                    BadCommand{"SceneTwice",
                               {"export", "DIR/tiny.json", "DIR/./tiny.json", "--out", "DIR/out"},
                               {"two scenes", "\"tiny\""}}),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Defects, BadFlag,
    testing::Values(BadCommand{"NoFile", {"defects"}, {"results"}},
                    BadCommand{"FileThatIsNone", {"defects", "DIR/none.json"}, {"none.json"}},
                    BadCommand{"NoResults", {"defects", "DIR/tiny.json"}, {"field schema"}},
                    BadCommand{"WriteWithAValue",
                               {"defects", "DIR/tiny.json", "--write", "DIR/other"},
                               {"DIR/other"}}),
    named_command);

INSTANTIATE_TEST_SUITE_P(
    Reproduce, BadFlag,
    testing::Values(
        BadCommand{"FlagOfRun", {"reproduce", "--no-timing", "--out", "DIR/out"}, {"--no-timing"}},
        BadCommand{"TooManyFrames",
                   {"reproduce", "--frames", "100001", "--out", "DIR/out"},
                   {"--frames", "100001"}},
        BadCommand{"NegativeThreads",
                   {"reproduce", "--threads", "-1", "--out", "DIR/out"},
                   {"--threads", "-1"}},
        BadCommand{"SceneFile",
                   {"reproduce", "DIR/tiny.json", "--out", "DIR/out"},
                   {"tiny.json\" is no scene of the paper"}},
        BadCommand{"OneSceneThatIsNone",
                   {"reproduce", "paper-teapot", "paper-teacup", "--out", "DIR/out"},
                   {"\"paper-teacup\"", "allowed: paper"}}),
    named_command);

}  // namespace
}  // namespace contactcheck::cli
