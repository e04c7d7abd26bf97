// Places that take no files, and disks that are full: one sentence, and nothing half-written stays.
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/reference/cli/refusal.h"
#include "tests/reference/cli/run_files.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using test::BadCommand;
using test::Outcome;
using test::Scratch;
using test::text_of;
using test::Words;
using testing::AnyOf;
using testing::HasSubstr;

class Unwritable : public testing::TestWithParam<BadCommand> {};

TEST_P(Unwritable, IsRefusedWithOneSentence) {
  const Scratch scratch;
  scratch.write("tiny.json", test::tiny_scene());
  scratch.write("file", "keep me");
  ASSERT_EQ(test::contactcheck_program({"run", (scratch.folder() / "tiny.json").string(), "--quiet",
                                        "--no-timing", "--detector", "fcl-aabb", "--out",
                                        (scratch.folder() / "old").string()})
                .exit_code,
            0);
  fs::create_directories(scratch.folder() / "taken" / "report.md" / "x");
  test::expect_refused(GetParam(), scratch);
}

std::string named(const testing::TestParamInfo<BadCommand>& test) { return test.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Places, Unwritable,
    testing::Values(
        BadCommand{"ReproduceBelowAFile",
                   {"reproduce", "--out", "DIR/file/deeper"},
                   {"--out DIR/file/deeper", "Not a directory"}},
        BadCommand{"ReproduceOntoAFile", {"reproduce", "--out", "DIR/file"}, {"--out DIR/file"}},
        BadCommand{"RunIntoALongName",
                   {"run", "DIR/tiny.json", "--out", "DIR/" + std::string(300, 'n')},
                   {"--out", "File name too long"}},
        BadCommand{"RunOnNoDevice",
                   {"run", "DIR/tiny.json", "--out", "/dev/null"},
                   {"--out /dev/null", "Not a directory"}},
        BadCommand{"ExportBelowAFile",
                   {"export", "DIR/tiny.json", "--out", "DIR/file/deeper"},
                   {"--out DIR/file/deeper", "Not a directory"}},
        BadCommand{"ExportOnNoDevice",
                   {"export", "DIR/tiny.json", "--out", "/dev/null"},
                   {"--out /dev/null", "Not a directory"}},
        BadCommand{"ReportBelowAFile",
                   {"report", "DIR/old/results.json", "--out", "DIR/file/deeper"},
                   {"DIR/file/deeper", "Not a directory"}},
        BadCommand{"ReportOntoAFile",
                   {"report", "DIR/old/results.json", "--out", "DIR/file"},
                   {"DIR/file", "Not a directory"}},
        BadCommand{"ReportWhereNobodyCanWrite",
                   {"report", "DIR/old/results.json", "--out", "/proc/contactcheck"},
                   {"/proc/contactcheck"}},
        BadCommand{"ReportInPlaceOfAFolder",
                   {"report", "DIR/old/results.json", "--out", "DIR/taken"},
                   {"DIR/taken/report.md", "Is a directory"}}),
    named);

// Printed results that do not arrive: in every command the same check at the end.
class BrokenOutput : public testing::Test {
 protected:
  BrokenOutput() { scene_ = scratch_.write("tiny.json", test::tiny_scene()).string(); }

  // The program with its standard streams as a shell has redirected them.
  static Outcome redirected(const std::string& redirections, const Words& command) {
    Words words = {"-c", "exec \"$0\" \"$@\" " + redirections, CONTACTCHECK_PROGRAM};
    words.insert(words.end(), command.begin(), command.end());
    return test::run_program("/bin/sh", words);
  }

  void expect_refused(const std::string& redirections, const std::string& reason) const {
    const std::string results = CONTACTCHECK_EXAMPLE_RESULTS,
                      policy = CONTACTCHECK_FIXTURES "/policies/default.json";
    for (const Words& command : std::vector<Words>{{"--help"},
                                                   {"--version"},
                                                   {"run", "--help"},
                                                   {"list"},
                                                   {"list", "--detectors"},
                                                   {"truth", "hard-boxes-gap"},
                                                   {"diff", results, results},
                                                   {"gate", results, "--policy", policy},
                                                   {"report", results, "--out", out("report")},
                                                   {"export", scene_, "--out", out("export")}}) {
      const Outcome outcome = redirected(redirections, command);
      EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(command);
      EXPECT_EQ(outcome.err, "contactcheck: cannot write to standard output: " + reason + "\n")
          << testing::PrintToString(command);
    }
  }

  Words run_into(const std::string& folder) const {
    return {"run",        scene_,     "--quiet", "--no-timing",
            "--detector", "fcl-aabb", "--out",   out(folder)};
  }
  std::string out(const std::string& name) const { return (scratch_.folder() / name).string(); }

  Scratch scratch_;
  std::string scene_;
};

TEST_F(BrokenOutput, FullDeviceIsNoSuccess) {
  expect_refused("> /dev/full", "No space left on device");
}

TEST_F(BrokenOutput, ClosedStreamIsNoSuccess) { expect_refused(">&-", "Bad file descriptor"); }

TEST_F(BrokenOutput, ClosedStreamsAreNoSuccess) {
  expect_refused("<&- >&-", "Bad file descriptor");
}

// No file that the run opens takes a closed stream's number: what is printed spoils none.
TEST_F(BrokenOutput, RunWritesItsFilesAllTheSame) {
  EXPECT_EQ(test::contactcheck_program(run_into("open")).exit_code, 0);
  Words words = run_into("closed");
  words.push_back("--json-lines");
  const Outcome outcome = redirected("<&- >&-", words);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, testing::StartsWith("contactcheck: cannot write to standard output"));
  for (const char* file : {"/contacts/tiny.json", "/recordings/tiny.ccr"}) {
    EXPECT_NE(text_of(out("open") + file), "");
    EXPECT_EQ(text_of(out("closed") + file), text_of(out("open") + file)) << file;
  }
  EXPECT_TRUE(nlohmann::json::accept(text_of(out("closed") + "/results.json")));
}

class FullDisk : public testing::Test {
 protected:
  FullDisk() { scene_ = scratch_.write("tiny.json", test::tiny_scene()).string(); }

  Words run_into(const fs::path& out) const {
    return {"run",        scene_,     "--quiet", "--no-timing",
            "--detector", "ffd-aabb", "--out",   out.string()};
  }

  // The results with their cases and contacts.
  static std::string state_of(const fs::path& out) {
    std::string state = text_of(out / "results.json");
    if (state.empty()) return "";
    const auto results = nlohmann::json::parse(state);
    for (const auto& d : results.at("disagreements")) {
      const std::string text = text_of(out / d.at("case").get<std::string>());
      EXPECT_TRUE(nlohmann::json::accept(text)) << d;
      state += text;
    }
    for (const auto& scene : results.at("scenes")) {
      const std::string text = text_of(out / scene.at("contacts").get<std::string>());
      EXPECT_TRUE(nlohmann::json::accept(text)) << scene.at("contacts");
      state += text;
    }
    return state;
  }

  // Either everything is there, or a sentence says why not and what was there is as it was.
  void expect_all_or_nothing(const Outcome& outcome, const fs::path& out,
                             const std::string& before) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(out)) names.insert(entry.path().filename());
    EXPECT_THAT(names, testing::IsSubsetOf(test::run_files({"partial", "plots"})));
    for (const auto& entry : fs::recursive_directory_iterator(out))
      EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
    if (outcome.exit_code == 0) {
      ++whole_;
      EXPECT_NE(state_of(out), "");
      return;
    }
    ++refused_;
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("contactcheck: "));
    EXPECT_THAT(outcome.err, AnyOf(HasSubstr("File too large"), HasSubstr("No space left")));
    EXPECT_THAT(outcome.err, AnyOf(HasSubstr(out.string()), HasSubstr("shared memory")));
    // The last files of all are the reports: before them, new results may be complete.
    if (state_of(out) != before) {
      EXPECT_THAT(outcome.err, HasSubstr("/report."));
    }
  }

  Scratch scratch_;
  std::string scene_;
  int whole_ = 0, refused_ = 0;
};

// Files may not grow beyond some size: every file of a run in turn is the one that meets it.
TEST_F(FullDisk, LimitOfAFileLeavesAllOrNothing) {
  const fs::path out = scratch_.folder() / "out";
  for (int blocks = 1; blocks <= 4096; blocks *= 2) {
    SCOPED_TRACE(blocks);
    const std::string before = state_of(out);
    Words words = {"-c", "ulimit -f " + std::to_string(blocks) + "; exec \"$0\" \"$@\"",
                   CONTACTCHECK_PROGRAM};
    for (const std::string& word : run_into(out)) words.push_back(word);
    expect_all_or_nothing(test::run_program("/bin/sh", words), out, before);
  }
  EXPECT_GT(refused_, 2);
  EXPECT_GT(whole_, 0);
}

/// A file system in memory of its own, of this many KiB; not there where mounting is not allowed.
class SmallDisk {
 public:
  SmallDisk(const fs::path& folder, int kib) : folder_(folder) {
    fs::create_directories(folder);
    const std::string size = "size=" + std::to_string(kib) + "k";
    mounted_ = mount("contactcheck", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
    if (!mounted_) why_ = std::strerror(errno);
  }
  ~SmallDisk() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }
  const std::string& why() const { return why_; }

 private:
  fs::path folder_;
  bool mounted_ = false;
  std::string why_;
};

TEST_F(FullDisk, DiskThatIsTooSmallLeavesAllOrNothing) {
  for (int kib = 16; kib <= 4096; kib *= 2) {
    SCOPED_TRACE(kib);
    const fs::path folder = scratch_.folder() / ("disk" + std::to_string(kib));
    const SmallDisk disk(folder, kib);
    if (!disk.mounted())
      GTEST_SKIP() << "run as root, in a container with CAP_SYS_ADMIN: a small disk is mounted ("
                   << disk.why() << ")";
    fs::create_directories(folder / "out");
    expect_all_or_nothing(test::contactcheck_program(run_into(folder / "out")), folder / "out", "");
  }
  EXPECT_GT(refused_, 0);
  EXPECT_GT(whole_, 0);
}

}  // namespace
}  // namespace contactcheck::cli
