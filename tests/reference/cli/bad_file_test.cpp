// Files that no command can use: what is wrong with them as files, whatever they were meant to be.
// (What may be wrong in a scene is tests/reference/scene/bad_scene_test.cpp; in a recording,
// tests/core/recording/recording_damage_test.cpp.)
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <functional>

#include "tests/reference/cli/gate_files.h"
#include "tests/reference/cli/refusal.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"
#include "tests/support/sanitizers.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using test::BadCommand;
using test::Scratch;
using test::text_of;
using test::Words;

using Prepare = std::function<void(const Scratch&)>;

struct BadFile {
  BadCommand command;
  Prepare prepare;
};
void PrintTo(const BadFile& file, std::ostream* out) { *out << file.command.name; }

class BadFiles : public testing::TestWithParam<BadFile> {};

TEST_P(BadFiles, AreRefusedWithOneSentence) {
  const Scratch scratch;
  scratch.write("tiny.json", test::tiny_scene());
  GetParam().prepare(scratch);
  test::expect_refused(GetParam().command, scratch);
}

std::string file_case(const testing::TestParamInfo<BadFile>& test) {
  return test.param.command.name;
}

Prepare bytes(const std::string& file, const std::string& content) {
  return [=](const Scratch& scratch) { scratch.write(file, content); };
}

Prepare folder(const std::string& name) {
  return [=](const Scratch& scratch) { fs::create_directories(scratch.folder() / name); };
}

Prepare link_to(const std::string& target, const std::string& name) {
  return [=](const Scratch& scratch) { fs::create_symlink(target, scratch.folder() / name); };
}

// Larger than any memory, and nothing on disk.
Prepare huge(const std::string& file) {
  return [=](const Scratch& scratch) {
    fs::resize_file(scratch.write(file, ""), std::uintmax_t{1} << 40);
  };
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string out;
  for (std::size_t i = 0; i < times; ++i) out += text;
  return out;
}

constexpr std::size_t kDeep = 100'000;
const std::string kBinary(
    "\x7f"
    "ELF\0\1\2\3\xff\xfe",
    10);

BadFile scene(const std::string& name, Prepare prepare, Words named) {
  named.emplace_back("DIR/x.json");
  return {{name, {"run", "DIR/tiny.json", "DIR/x.json", "--out", "DIR/out"}, named},
          std::move(prepare)};
}

INSTANTIATE_TEST_SUITE_P(
    Scene, BadFiles,
    testing::Values(
        scene("Missing", [](const Scratch&) {}, {"x.json\" does not exist"}),
        scene("Folder", folder("x.json"), {"is a folder"}),
        scene("DanglingLink", link_to("nowhere", "x.json"), {"does not exist"}),
        scene("LinkToItself", link_to("x.json", "x.json"), {"does not exist"}),
        BadFile{{"LongName", {"run", "DIR/" + std::string(300, 'n') + ".json"}, {"does not exist"}},
                [](const Scratch&) {}},
        scene("Huge", huge("x.json"), {"has more than 256 MiB"}),
        scene("Endless", link_to("/dev/zero", "x.json"), {"is a device, not a regular file"}),
        scene("Empty", bytes("x.json", ""), {"is empty"}),
        scene("Blank", bytes("x.json", " \n\n"), {"ends too early", "line 3, column 1"}),
        scene("Binary", bytes("x.json", kBinary), {"is not valid JSON at line 1, column 1"}),
        scene("NotUtf8", bytes("x.json", "{\"id\": \"\xff\"}"), {"is not valid JSON at line 1"}),
        scene("DeepArrays", bytes("x.json", repeated("[", kDeep)), {"deeper than 64 levels"}),
        scene("DeepObjects", bytes("x.json", repeated("{\"a\":", kDeep)),
              {"deeper than 64 levels"}),
        scene("ClosedDeepArrays", bytes("x.json", repeated("[", kDeep) + repeated("]", kDeep)),
              {"deeper than 64 levels"}),
        scene("ManyFields", bytes("x.json", "{" + repeated("\"a\": 1, ", 3) + "\"b\": 2}"),
              {"a is given twice"}),
        scene("Infinity", bytes("x.json", R"({"duration": Infinity})"),
              {"line 1, column 14", "\"duration\": I"}),
        scene("Hexadecimal", bytes("x.json", R"({"frames": 0x10})"), {"line 1, column 13"}),
        scene("Comment", bytes("x.json", "// a scene\n{}"), {"line 1, column 1"})),
    file_case);

// The scene DIR/m.json with DIR/x.obj for its first mesh.
BadFile mesh(const std::string& name, const Prepare& prepare, Words named) {
  named.emplace_back("DIR/x.obj");
  named.emplace_back("bodies[0].mesh cannot be loaded");
  const auto with_scene = [prepare](const Scratch& scratch) {
    std::string text = test::tiny_scene();
    const std::string box = R"("shape": "box", "divisions": 2)";
    scratch.write("m.json", text.replace(text.find(box), box.size(), R"("file": "x.obj")"));
    prepare(scratch);
  };
  return {{name, {"run", "DIR/m.json", "--out", "DIR/out"}, named}, with_scene};
}

const std::string kFace = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

INSTANTIATE_TEST_SUITE_P(
    Mesh, BadFiles,
    testing::Values(mesh("Folder", folder("x.obj"), {"is a folder"}),
                    mesh("Empty", bytes("x.obj", ""), {"is empty"}),
                    mesh("Huge", huge("x.obj"), {"has more than 4096 MiB"}),
                    mesh("Binary", bytes("x.obj", kBinary), {"DIR/m.json"}),
                    mesh("NotANumber", bytes("x.obj", "v nan 0 0\n" + kFace), {"nan"}),
                    mesh("Infinite", bytes("x.obj", "v 1e999 0 0\n" + kFace), {"1e999"}),
                    mesh("VertexThatIsNotThere", bytes("x.obj", kFace + "f 1 2 9\n"),
                         {"face 1 (line 5) names the vertex 9; the file has 3"}),
                    mesh("OnlyVertices", bytes("x.obj", "v 0 0 0\nv 1 0 0\n"),
                         {"x.obj\" holds no face"})),
    file_case);

// As clusters and containers limit it. Files of a gigabyte are allowed, and here nothing on disk.
TEST(LittleMemory, EndsInASentenceThatNamesAMesh) {
  // Sanitizers reserve more addresses than a limit leaves them.
  if (test::kSanitizerAllocates) GTEST_SKIP() << "a sanitizer is at work";
  const Scratch scratch;
  const std::string mesh = scratch.write("x.obj", "").string(),
                    results = scratch.write("x.json", "").string();
  fs::resize_file(mesh, std::uintmax_t{1} << 30);
  fs::resize_file(results, std::uintmax_t{200} << 20);
  const auto sentence = [](Words words) {
    words.insert(words.begin(),
                 {"-c", "ulimit -v 300000 && exec \"$0\" \"$@\"", CONTACTCHECK_PROGRAM});
    const test::Outcome outcome = test::run_program("/bin/sh", words);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(sentence({"run", "--mesh", mesh, "--mesh", mesh, "--detector", "fcl-aabb"}),
              testing::EndsWith("\"" + mesh + "\" cannot be read: it takes more memory than " +
                                "there is.\n"));
  EXPECT_EQ(sentence({"report", results}),
            "contactcheck: memory ran out: this takes more than the process may have\n");
}

BadFile suite(const std::string& name, const std::string& content, const Words& named) {
  return {{name, {"run", "DIR/u.json", "--out", "DIR/out"}, named}, bytes("u.json", content)};
}

INSTANTIATE_TEST_SUITE_P(
    Suite, BadFiles,
    testing::Values(
        suite("UnknownScene", R"({"id": "u", "scenes": ["atlantis"], "detectors": ["embree"]})",
              {"no scene \"atlantis\"", "`contactcheck list` names all"}),
        suite("UnknownDetector",
              R"({"id": "u", "scenes": ["bunny-touch"], "detectors": ["embers"]})",
              {"unknown detector \"embers\""}),
        suite("UnknownDetectorOption",
              R"({"id": "u", "scenes": ["bunny-touch"], "detectors": ["embree:a=1"]})",
              {"\"embree:a=1\": unknown option \"a\""}),
        suite("UnknownKey", R"({"id": "u", "scenes": ["bunny-touch"], "detector": ["embree"]})",
              {"DIR/u.json", "detector is not a known key"}),
        suite("ScenesOfAnotherType", R"({"id": "u", "scenes": 7, "detectors": ["embree"]})",
              {"DIR/u.json", "scenes is 7"}),
        suite("GoalOfAnUnknownDetector",
              R"({"id": "u", "scenes": ["bunny-touch"], "detectors": ["embree"], "goals": [
                  {"goal": "g", "scene": "bunny-touch", "detector": "embers", "per": "pair",
                   "part": "playback", "at_most": 1}]})",
              {"unknown detector \"embers\""})),
    file_case);

BadFile recording(const std::string& name, Prepare prepare, Words named) {
  named.emplace_back("DIR/x.ccr");
  return {{name, {"run", "DIR/x.ccr", "--out", "DIR/out"}, named}, std::move(prepare)};
}

INSTANTIATE_TEST_SUITE_P(
    Recording, BadFiles,
    testing::Values(recording("Missing", [](const Scratch&) {}, {"does not exist"}),
                    recording("Folder", folder("x.ccr"), {"not a regular file"}),
                    recording("Endless", link_to("/dev/zero", "x.ccr"), {"not a regular file"}),
                    recording("Empty", bytes("x.ccr", ""), {"not a recording"}),
                    recording("Json", bytes("x.ccr", test::tiny_scene()),
                              {"not a recording", "first 8 bytes"}),
                    recording("Huge", huge("x.ccr"), {"not a recording"}),
                    recording("HugeWithTheRightBeginning",
                              [](const Scratch& scratch) {
                                const std::string start(
                                    "\x89"
                                    "CCR\r\n\x1a\n\1\0\0\0\0\0\0\0",
                                    16);
                                fs::resize_file(scratch.write("x.ccr", start),
                                                std::uintmax_t{1} << 40);
                              },
                              {"1099511627776 bytes but was written with 0"}),
                    recording("OtherVersion",
                              bytes("x.ccr", std::string("\x89"
                                                         "CCR\r\n\x1a\n\3\0\0\0\0\0\0\0",
                                                         16) +
                                                 std::string(64, '\0')),
                              {"version 3 is not known, only versions 1 and 2"})),
    file_case);

TEST(CutRecording, IsRefusedWhereverItIsCut) {
  const Scratch scratch;
  const fs::path scene = scratch.write("tiny.json", test::tiny_scene("tiny", "1"));
  const fs::path out = scratch.folder() / "whole";
  ASSERT_EQ(test::contactcheck_program({"run", scene.string(), "--no-timing", "--detector",
                                        "fcl-aabb", "--out", out.string()})
                .exit_code,
            0);
  const std::string whole = text_of(out / "recordings" / "tiny.ccr");
  ASSERT_GT(whole.size(), 1000u);
  std::vector<std::size_t> cuts = {1, 8, 12, 16, 24, 31, 32, whole.size() - 8, whole.size() - 1};
  for (std::size_t i = 1; i < 24; ++i) cuts.push_back(i * whole.size() / 24);
  for (const std::size_t cut : cuts) {
    SCOPED_TRACE(cut);
    scratch.write("x.ccr", whole.substr(0, cut));
    test::expect_refused({"", {"run", "DIR/x.ccr", "--out", "DIR/out"}, {"DIR/x.ccr"}}, scratch);
  }
}

// The file DIR/x with this ending is a pipe that nobody writes to: it is not waited for.
BadFile pipe(const std::string& name, const std::string& ending, Words words) {
  const std::string file = "x" + ending;
  const auto prepare = [file](const Scratch& scratch) {
    test::write_gate_files(scratch);
    scratch.write("suite.json", R"({"id": "u", "scenes": [{"file": "x.json"}],
                                    "detectors": ["fcl-aabb"]})");
    scratch.write("cached.json", R"({"id": "c", "duration": 1, "levels": ["body"], "bodies": [
      {"name": "b", "mesh": {"shape": "box"}, "recording": {"cache": "x.pc2"}}]})");
    scratch.write("numbered.json", R"({"id": "n", "duration": 1, "levels": ["body"], "bodies": [
      {"name": "b", "recording": {"frames": "%d.obj"}}]})");
    scratch.write("case.json", R"({"scene": "s", "frame": 0, "detector": "fcl-aabb",
      "level": "body", "kind": "missed", "first": {}, "second": {}, "recording": "x.ccr"})");
    EXPECT_EQ(mkfifo((scratch.folder() / file).c_str(), 0600), 0);
  };
  return {{name, std::move(words), {"DIR/" + file + "\" is a pipe, not a regular file"}}, prepare};
}

INSTANTIATE_TEST_SUITE_P(
    Pipe, BadFiles,
    testing::Values(
        pipe("Scene", ".json", {"run", "DIR/x.json", "--out", "DIR/out"}),
        pipe("SceneToTune", ".json", {"tune", "DIR/x.json", "--out", "DIR/out"}),
        pipe("SceneToExport", ".json", {"export", "DIR/x.json", "--out", "DIR/out"}),
        pipe("SceneOfASuite", ".json", {"run", "DIR/suite.json", "--out", "DIR/out"}),
        pipe("Recording", ".ccr", {"run", "DIR/x.ccr", "--out", "DIR/out"}),
        pipe("PointCache", ".pc2", {"run", "DIR/cached.json", "--out", "DIR/out"}),
        pipe("Mesh", ".obj",
             {"run", "--mesh", "DIR/x.obj", "--mesh", "DIR/x.obj", "--out", "DIR/out"}),
        pipe("MeshForAssimp", ".glb",
             {"run", "--mesh", "DIR/x.glb", "--mesh", "DIR/x.glb", "--out", "DIR/out"}),
        pipe("Results", ".json", {"report", "DIR/x.json", "--out", "DIR/out"}),
        pipe("ResultsBefore", ".json", {"diff", "DIR/x.json", "DIR/results.json"}),
        pipe("ResultsAfter", ".json", {"diff", "DIR/results.json", "DIR/x.json"}),
        pipe("ResultsOfAShard", ".json", {"merge", "DIR/x.json", "--out", "DIR/out"}),
        pipe("ResultsOfHardCases", ".json", {"defects", "DIR/x.json"}),
        pipe("ResultsToAccept", ".json", {"accept", "DIR/x.json", "--as", "DIR/baseline.json"}),
        pipe("BaselineInPlace", ".json", {"accept", "DIR/results.json", "--as", "DIR/x.json"}),
        pipe("ResultsAtTheGate", ".json", {"gate", "DIR/x.json", "--policy", "DIR/policy.json"}),
        pipe("Policy", ".json", {"gate", "DIR/results.json", "--policy", "DIR/x.json"}),
        pipe("Baseline", ".json",
             {"gate", "DIR/results.json", "--policy", "DIR/policy.json", "--baseline",
              "DIR/x.json"}),
        pipe("Case", ".json", {"reduce", "DIR/x.json", "--out", "DIR/out"}),
        pipe("RecordingOfACase", ".ccr", {"reduce", "DIR/case.json", "--out", "DIR/out"})),
    file_case);

// Commands that read the fixtures, with a folder of fixtures that is broken.
BadFile fixtures(const std::string& name, const Words& words, Prepare prepare, const Words& named) {
  return {{name, words, named}, std::move(prepare)};
}

class BadFixtures : public BadFiles {};

TEST_P(BadFixtures, AreRefusedWithOneSentence) {
  const Scratch scratch;
  scratch.write("tiny.json", test::tiny_scene());
  GetParam().prepare(scratch);
  const test::Environment own("CONTACTCHECK_FIXTURES", (scratch.folder() / "f").string());
  test::expect_refused(GetParam().command, scratch);
}

const Words kList = {"list"}, kRun = {"run", "DIR/tiny.json", "--out", "DIR/out"},
            kReproduce = {"reproduce", "--out", "DIR/out"};

Prepare scene_fixture(const std::string& content) {
  return [=](const Scratch& scratch) {
    scratch.write("f/suites/none.txt", "");
    scratch.write("f/scenes/a.json", content);
  };
}

INSTANTIATE_TEST_SUITE_P(
    Fixtures, BadFixtures,
    testing::Values(
        fixtures("ListOfNone", kList, [](const Scratch&) {},
                 {"DIR/f/suites", "does not exist", "$CONTACTCHECK_FIXTURES"}),
        fixtures("ListOfAFile", kList, bytes("f", "text"), {"DIR/f/suites", "does not exist"}),
        fixtures("RunWithoutTheSuiteOfItsDetectors", kRun, folder("f"), {"\"default\""}),
        fixtures("ReproduceWithoutTables", kReproduce, folder("f"), {"tables.json", "not exist"}),
        fixtures("ReproduceWithBrokenTables", kReproduce, bytes("f/paper/tables.json", "{"),
                 {"DIR/f/paper/tables.json", "line 1, column 2"}),
        fixtures("ListOfABrokenScene", {"list", "--scenes"}, scene_fixture("{\"id\": "),
                 {"DIR/f/scenes/a.json", "line 1, column 8"}),
        fixtures("ListOfASceneOfAnotherName", {"list", "--scenes"}, scene_fixture(R"({"id": "b"})"),
                 {"DIR/f/scenes/a.json", "id is \"b\""}),
        fixtures("ListOfADeepScene", {"list", "--scenes"}, scene_fixture(repeated("[", kDeep)),
                 {"DIR/f/scenes/a.json", "deeper than 64"})),
    file_case);

}  // namespace
}  // namespace contactcheck::cli
