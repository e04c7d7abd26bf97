// Every kind of defect of scene and suite files: the whole sentence.
#include <gmock/gmock.h>

#include <algorithm>

#include "reference/scene/scene.h"
#include "reference/scene/suite_file.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

using test::Scratch;
using test::sentence_of;

const std::string kGood = R"({
  "id": "s", "title": "A scene", "frames": 2, "duration": 1, "levels": ["body"],
  "bodies": [
    {"name": "left", "mesh": {"shape": "box"}, "lattice": {"cells": [1, 1, 1]}},
    {"name": "right", "mesh": {"shape": "sphere", "divisions": 1, "size": 1},
     "lattice": {"kept": 8},
     "motion": {"position": [[0, [0, 0, 0]], [1, [1, 0, 0]]],
                "spins": [{"axis": "z", "degrees": 10}],
                "deformers": [{"bend": {"axis": "y", "toward": "x", "degrees": 20}}]}}
  ]
})";

struct Defect {
  std::string name, from, to, sentence;  // the sentence after: scene file "PATH"
};
void PrintTo(const Defect& p, std::ostream* out) { *out << p.name; }

class BadScene : public ::testing::TestWithParam<Defect> {};

TEST_P(BadScene, IsRefusedWithOneSentence) {
  const Defect& defect = GetParam();
  const Scratch scratch;
  std::string text = kGood;
  ASSERT_NE(text.find(defect.from), std::string::npos);
  text.replace(text.find(defect.from), defect.from.size(), defect.to);
  const std::filesystem::path file = scratch.write("s.json", text);
  std::string expected = "scene file \"" + file.string() + "\"" + defect.sentence;
  const std::size_t folder = expected.find("FOLDER");
  if (folder != std::string::npos) expected.replace(folder, 6, scratch.folder().string());
  EXPECT_EQ(sentence_of([&] { load_scene(file); }), expected);
}

TEST(SceneDefects, ANulByteEndsNothing) {
  const Scratch scratch;
  const auto after = [&](const std::string& bytes) {
    const std::filesystem::path file = scratch.write("s.json", bytes);
    const std::string sentence = sentence_of([&] { load_scene(file); });
    return sentence.substr(std::min(sentence.size(), file.string().size() + 13));
  };
  EXPECT_EQ(after(kGood + '\0'), " is not valid JSON at line 11, column 2: a NUL byte.");
  EXPECT_EQ(after(kGood + "\n" + '\0' + "more"),
            " is not valid JSON at line 12, column 1: a NUL byte.");
  scratch.write("t.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  std::string text = kGood;
  const std::string box = R"("shape": "box")";
  EXPECT_EQ(after(text.replace(text.find(box), box.size(), R"("file": "t.off\u0000zz")")),
            ": bodies[0].mesh.file is \"t.off?zz\"; it must be a text without the character "
            "U+0000.");
}

TEST(SceneDefects, TheSceneWithoutThemLoads) {
  const Scratch scratch;
  EXPECT_EQ(load_scene(scratch.write("s.json", kGood)).bodies.size(), 2u);
}

std::string named(const ::testing::TestParamInfo<Defect>& test) { return test.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Syntax, BadScene,
    ::testing::Values(Defect{"MissingComma", R"("id": "s",)", R"("id": "s")",
                             " is not valid JSON at line 2, column 19, near \"title\"."},
                      Defect{"CutShort", "  ]\n}", "",
                             " is not valid JSON: it ends too early, at line 10, column 1."},
                      Defect{"NotANumber", "\"frames\": 2", "\"frames\": NaN",
                             " is not valid JSON at line 2, column 44, near \"frames\": N."},
                      Defect{"Overflow", "\"duration\": 1", "\"duration\": 1e999",
                             " is not valid JSON at line 2, column 63, near \"1e999\"."},
                      Defect{"DuplicateKey", R"("size": 1})", R"("size": 1, "size": 2})",
                             ": bodies[1].mesh.size is given twice."},
                      Defect{"NotAnObject", kGood, "[1]",
                             ": the document is an array of 1; it must be an object."}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Head, BadScene,
    ::testing::Values(
        Defect{"UnknownKey", R"("frames": 2)", R"("frames": 2, "frame": 3)",
               ": frame is not a known key; did you mean frames? allowed here: id, title, drawn, "
               "frames, duration, time_step, simulation, sweep, levels, bodies."},
        Defect{"MissingKey", R"("frames": 2, )", "", ": frames is missing."},
        Defect{"BadId", R"("id": "s")", R"("id": "../s")",
               ": id is \"../s\"; it must be letters, digits, '-', '_' and '.', beginning with a "
               "letter or digit, at most 64."},
        Defect{"WrongType", R"("title": "A scene")", R"("title": 5)",
               ": title is 5; it must be a text that is not empty."},
        Defect{"ZeroFrames", R"("frames": 2)", R"("frames": 0)",
               ": frames is 0; it must be a whole number from 1 to 100000."},
        Defect{"HalfAFrame", R"("frames": 2)", R"("frames": 2.5)",
               ": frames is 2.5; it must be a whole number from 1 to 100000."},
        Defect{"FramesAsText", R"("frames": 2)", R"("frames": "2")",
               ": frames is \"2\"; it must be a whole number from 1 to 100000."},
        Defect{"NegativeDuration", R"("duration": 1)", R"("duration": -1)",
               ": duration is -1; it must be a number above 0 and at most 1e+06."},
        Defect{"BothTimes", R"("duration": 1)", R"("duration": 1, "time_step": 1)",
               ": the document has both \"duration\" and \"time_step\"; exactly one of duration, "
               "time_step is allowed."},
        Defect{"NoTime", R"("duration": 1, )", "",
               ": the document has none of the keys duration, time_step; exactly one is needed."},
        Defect{"UnknownLevel", R"(["body"])", R"(["body", "edge"])",
               ": levels[1] is \"edge\"; it must be one of body, containment, cell, box, triangle, "
               "vertex, near, self, self-vertex, self-edge, self-body, self-cell, self-near, "
               "impact-vf, impact-ee, impact-triangle, impact, impact-self-vf, impact-self-ee."},
        Defect{"RepeatedLevel", R"(["body"])", R"(["body", "body"])",
               ": levels[1] is \"body\"; it must be named once only."},
        Defect{"NoLevel", R"(["body"])", "[]",
               ": levels is an array of 0; it must be an array of at least 1."}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Bodies, BadScene,
    ::testing::Values(
        Defect{"DuplicateName", R"("name": "right")", R"("name": "left")",
               ": bodies[1].name is \"left\"; it must be different from bodies[0].name."},
        Defect{"ControlCharacter", R"("name": "right")", R"("name": "ri\nght")",
               ": bodies[1].name has a control character and cannot be a name."},
        Defect{"UnknownKey", R"("lattice": {"kept": 8})", R"("latice": {"kept": 8})",
               ": bodies[1].latice is not a known key; did you mean lattice? allowed here: name, "
               "copies, mesh, lattice, motion, recording, material, velocity."},
        Defect{"ZeroCells", "[1, 1, 1]", "[0, 1, 1]",
               ": bodies[0].lattice.cells[0] is 0; it must be a whole number from 1 to 128."},
        Defect{"TwoCells", "[1, 1, 1]", "[1, 1]",
               ": bodies[0].lattice.cells is an array of 2; it must be an array of three whole "
               "numbers."},
        Defect{"NegativeKept", R"({"kept": 8})", R"({"kept": -8})",
               ": bodies[1].lattice.kept is -8; it must be a whole number from 1 to 10000."},
        Defect{"NegativePadding", R"({"kept": 8})", R"({"kept": 8, "padding": -0.5})",
               ": bodies[1].lattice.padding is -0.5; it must be a number of at least 0 and at most "
               "1."},
        Defect{"LatticeAsNumber", R"({"kept": 8})", "8",
               ": bodies[1].lattice is 8; it must be an object."}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Meshes, BadScene,
    ::testing::Values(
        Defect{"UnknownShape", R"("shape": "box")", R"("shape": "cone")",
               ": bodies[0].mesh.shape is \"cone\"; it must be one of box, sphere, torus, letter, "
               "sheet, teapot."},
        Defect{"TwoSources", R"("shape": "box")", R"("shape": "box", "file": "a.obj")",
               ": bodies[0].mesh has both \"file\" and \"shape\"; exactly one of dataset, file, "
               "shape is allowed."},
        Defect{"NoSource", R"("shape": "box")", R"("size": 1)",
               ": bodies[0].mesh has none of the keys dataset, file, shape; exactly one is "
               "needed."},
        Defect{"KeyOfAnotherShape", R"("shape": "box")", R"("shape": "box", "tube": 0.5)",
               ": bodies[0].mesh.tube is not a known key; allowed here: shape, triangles, "
               "subdivide, size, scale, center, weld, divisions, sides."},
        Defect{"NegativeSize", R"("size": 1)", R"("size": -1)",
               ": bodies[1].mesh.size is -1; it must be a number above 0 and at most 1e+06."},
        Defect{"SizeAndScale", R"("size": 1)", R"("size": 1, "scale": 2)",
               ": bodies[1].mesh has both \"size\" and \"scale\"; at most one of them is allowed."},
        Defect{"Divisions", R"("divisions": 1)", R"("divisions": 99)",
               ": bodies[1].mesh.divisions is 99; it must be a whole number from 0 to 7."},
        Defect{"NegativeSide", R"("shape": "box")", R"("shape": "box", "sides": [1, -1, 1])",
               ": bodies[0].mesh.sides[1] is -1; it must be a number above 0 and at most 1e+06."},
        Defect{"UnknownLetter", R"("shape": "box")", R"("shape": "letter", "letter": "Q")",
               ": bodies[0].mesh.letter is \"Q\"; it must be one of A, B, C, D, E, H, I, L, O, P, "
               "R, T, U."},
        Defect{"TooManyTriangles", R"("size": 1)", R"("triangles": 900)",
               ": bodies[1].mesh.triangles is 900; it must be at most 80, the mesh's own number."},
        Defect{"MissingFile", R"("shape": "box")", R"("file": "no.obj")",
               ": bodies[0].mesh cannot be loaded: mesh file \"FOLDER/no.obj\" does not exist."}),
    named);

const std::string kBend = R"({"bend": {"axis": "y", "toward": "x", "degrees": 20}})";

INSTANTIATE_TEST_SUITE_P(
    Motions, BadScene,
    ::testing::Values(
        Defect{
            "UnknownDeformer", "\"bend\"", "\"shear\"",
            ": bodies[1].motion.deformers[0].shear is not a known key; allowed here: twist, bend, "
            "taper, stretch, nodes."},
        Defect{"UnknownAxis", R"("axis": "y")", R"("axis": "w")",
               ": bodies[1].motion.deformers[0].bend.axis is \"w\"; it must be one of x, y, z."},
        Defect{"BendAlongItself", R"("toward": "x")", R"("toward": "y")",
               ": bodies[1].motion.deformers[0].bend.toward is \"y\"; it must be another axis than "
               "\"axis\"."},
        Defect{"KeysNotIncreasing", "[1, [1, 0, 0]]", "[0, [1, 0, 0]]",
               ": bodies[1].motion.position[1][0] is 0; it must be above 0, the time of the key "
               "before."},
        Defect{"KeyWithoutValue", "[1, [1, 0, 0]]", "[1]",
               ": bodies[1].motion.position[1] is an array of 1; it must be a key: an array of a "
               "time and a value."},
        Defect{
            "CurveOfTexts", R"("degrees": 20)", R"("degrees": [[0, "a"]])",
            ": bodies[1].motion.deformers[0].bend.degrees[0][1] is \"a\"; it must be a number of "
            "at least -1e+06 and at most 1e+06."},
        Defect{"EmptyCurve", R"("degrees": 20)", R"("degrees": [])",
               ": bodies[1].motion.deformers[0].bend.degrees is an array of 0; it must be an array "
               "of at least 1."},
        Defect{"Ease", R"("spins")", R"("ease": "bounce", "spins")",
               ": bodies[1].motion.ease is \"bounce\"; it must be one of linear, smooth."},
        Defect{"ZeroSpinAxis", R"("axis": "z")", R"("axis": [0, 0, 0])",
               ": bodies[1].motion.spins[0].axis is too short; it must not be zero."},
        Defect{"StretchToNothing", kBend, R"({"stretch": {"axis": "x", "amount": -1}})",
               ": bodies[1].motion.deformers[0].stretch.amount is -1; it must be a number above -1 "
               "and at most 100."},
        Defect{"NodeOutsideTheGrid", kBend,
               R"({"nodes": [[0, [{"node": [0, 0, 9], "offset": [0, 0, 0]}]]]})",
               ": bodies[1].motion.deformers[0].nodes[0][1][0].node[2] is 9; it must be a whole "
               "number from 0 to 2."},
        Defect{"NodeTwice", kBend,
               R"({"nodes": [[0, [{"node": [0, 0, 0], "offset": [0, 0, 0]},
                                  {"node": [0, 0, 0], "offset": [0, 0, 1]}]]]})",
               ": bodies[1].motion.deformers[0].nodes[0][1][1].node is named twice in this key."}),
    named);

TEST(SceneDefects, NodeKeysNeedALattice) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.write("s.json", R"({"id": "s", "frames": 1,
    "duration": 1, "levels": ["body"], "bodies": [{"name": "a", "mesh": {"shape": "box"},
    "motion": {"deformers": [{"nodes": [[0, []]]}]}}]})");
  EXPECT_EQ(sentence_of([&] { load_scene(file); }),
            "scene file \"" + file.string() +
                "\": bodies[0].motion.deformers[0].nodes needs a lattice; this body has none.");
}

TEST(SceneDefects, DeepNestingIsRefusedBeforeItExhaustsTheStack) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.write("s.json", std::string(1'000'000, '['));
  EXPECT_THAT(sentence_of([&] { load_scene(file); }),
              ::testing::EndsWith("is nested deeper than 64 levels."));
}

// Found by fuzzers: keys and broken texts were quoted as they are, whatever they hold.
TEST(SceneDefects, KeysAndBrokenTextsAreShownShortAndWithoutControlCharacters) {
  const Scratch scratch;
  const auto after = [&](const std::string& bytes) {
    const std::filesystem::path file = scratch.write("s.json", bytes);
    const std::string sentence = sentence_of([&] { load_scene(file); });
    return sentence.substr(std::min(sentence.size(), file.string().size() + 13));
  };
  EXPECT_EQ(after("{\"a\x7f\n\": 1}"),
            " is not valid JSON at line 1, column 5, near \"a?<U+000A>.");
  EXPECT_THAT(after(R"({"a\n\u001bb": 1})"),
              ::testing::StartsWith(": a??b is not a known key; allowed here: "));
  const std::string key(5000, 'k'), shown = std::string(100, 'k') + "...";
  EXPECT_THAT(after("{\"" + key + "\": 1}"),
              ::testing::StartsWith(": " + shown + " is not a known key; allowed here: "));
  EXPECT_EQ(after("{\"" + key + "\": 1, \"" + key + "\": 2}"), ": " + shown + " is given twice.");
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "{\"" + key + "\": ";
  EXPECT_EQ(after(deep).size(), 338u);
}

TEST(SceneDefects, MissingPackageNamesFieldAndPackage) {
  const Scratch scratch;
  const test::Environment data("CONTACTCHECK_DATA", scratch.folder().string());
  const std::filesystem::path file = scratch.write("s.json", R"({"id": "s", "frames": 1,
    "duration": 1, "levels": ["body"], "bodies": [{"name": "a", "mesh": {"dataset": "cow"}}]})");
  EXPECT_THAT(
      sentence_of([&] { load_scene(file); }),
      ::testing::HasSubstr("bodies[0].mesh cannot be loaded: the Debian package libcgal-demo "
                           "is missing (no file "));
}

TEST(SuiteFile, DefectsAreRefusedWithOneSentence) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& text) {
    const std::filesystem::path file = scratch.write("u.json", text);
    const std::string sentence = sentence_of([&] { load_suite(file); });
    const std::string start = "suite file \"" + file.string() + "\": ";
    EXPECT_EQ(sentence.substr(0, start.size()), start);
    return sentence.substr(std::min(start.size(), sentence.size()));
  };
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": [], "detectors": ["d"]})"),
            "scenes is an array of 0; it must be an array of at least 1.");
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": ["a", "a"], "detectors": ["d"]})"),
            "scenes[1] is \"a\"; it must be named once only.");
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": ["a"]})"), "detectors is missing.");
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": ["a"], "detectors": [""]})"),
            "detectors[0] is \"\"; it must be a text that is not empty.");
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": ["a", {"scene": "a", "detectors": ["e"]}],
                        "detectors": ["d"]})"),
            "scenes[1] is an object; it must be named once only.");
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": [{"scene": "a"}], "detectors": ["d"]})"),
            "scenes[0].detectors is missing.");
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": [{"scene": "a", "file": "a.json"}],
                        "detectors": ["d"]})"),
            "scenes[0] has both \"scene\" and \"file\"; exactly one of scene, file is allowed.");
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": [{"file": "a.obj"}], "detectors": ["d"]})"),
            "scenes[0].file is \"a.obj\"; it must be the path of a scene file (.json) or of a "
            "recording (.ccr).");
  EXPECT_EQ(refusal(R"({"id": "u", "scenes": [{"file": "a.json"}, {"file": "b/../a.json"}],
                        "detectors": ["d"]})"),
            "scenes[1] is an object; it must be named once only.");
}

TEST(SuiteFile, DefectsOfGoalsAreRefusedWithOneSentence) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& goal) {
    const std::filesystem::path file = scratch.write(
        "u.json", R"({"id": "u", "scenes": ["a"], "detectors": ["d"], "goals": [)" + goal + "]}");
    const std::string sentence = sentence_of([&] { load_suite(file); });
    return sentence.substr(("suite file \"" + file.string() + "\": ").size());
  };
  EXPECT_EQ(refusal(""), "goals is an array of 0; it must be an array of at least 1.");
  EXPECT_EQ(
      refusal(R"({"goal": "g", "scene": "a", "detector": "d", "over": "e", "per": "pair",
                        "part": "playback", "at_least": 1})"),
      "goals[0] has both \"over\" and \"per\"; exactly one of over, over_scene, per is allowed.");
  EXPECT_EQ(refusal(R"({"goal": "g", "scene": "a", "detector": "d", "per": "vertex",
                        "part": "playback", "at_least": 1})"),
            "goals[0].per is \"vertex\"; it must be one of pair.");
  EXPECT_EQ(refusal(R"({"goal": "g", "scene": "a", "detector": "d", "over": "e",
                        "part": "tepid", "at_least": 1})"),
            "goals[0].part is \"tepid\"; it must be one of playback, cold, contact_frames.");
  EXPECT_EQ(refusal(R"({"goal": "g", "scene": "a", "detector": "d", "over": "e",
                        "part": "playback", "at_most": 0})"),
            "goals[0].at_most is 0; it must be a number above 0.");
}

TEST(SuiteFile, HoldsScenesWithDetectorsOfTheirOwnAndGoals) {
  const Scratch scratch;
  const Suite suite = load_suite(scratch.write("u.json", R"({
    "id": "u", "scenes": ["a", {"scene": "b", "detectors": ["e", "f"]}], "detectors": ["d"],
    "goals": [
      {"goal": "faster", "scene": "a", "detector": "d", "over": "e", "part": "cold", "at_least": 2},
      {"goal": "flat", "scene": "b", "detector": "d", "over_scene": "a", "part": "playback",
       "at_most": 1.1},
      {"goal": "cheap", "scene": "a", "detector": "d", "per": "pair", "part": "contact_frames",
       "at_most": 0.5}]})"));
  ASSERT_EQ(suite.scenes.size(), 2u);
  EXPECT_TRUE(suite.scenes[0].detectors.empty());
  EXPECT_EQ(suite.scenes[1].detectors, (std::vector<std::string>{"e", "f"}));
  ASSERT_EQ(suite.goals.size(), 3u);
  EXPECT_EQ(suite.goals[0].kind, SuiteGoal::Kind::kOver);
  EXPECT_EQ(suite.goals[0].other, "e");
  EXPECT_EQ(suite.goals[0].at_least, 2.0);
  EXPECT_EQ(suite.goals[0].at_most, std::nullopt);
  EXPECT_EQ(suite.goals[1].kind, SuiteGoal::Kind::kOverScene);
  EXPECT_EQ(suite.goals[1].other, "a");
  EXPECT_EQ(suite.goals[2].kind, SuiteGoal::Kind::kPerPair);
  EXPECT_EQ(suite.goals[2].part, "contact_frames");
  EXPECT_EQ(suite.goals[2].at_most, 0.5);
}

TEST(SuiteFile, FindsSceneFilesAndRecordingsBesideItself) {
  const Scratch scratch;
  const std::filesystem::path home = std::filesystem::canonical(scratch.folder());
  const std::string text = R"({"id": "u", "detectors": ["d"], "scenes": [
    "a", {"file": "../b.json"}, {"file": "c.ccr", "detectors": ["e"]}, {"file": "/d.json"}]})";
  const Suite suite = load_suite(scratch.write("suites/u.json", text));
  ASSERT_EQ(suite.scenes.size(), 4u);
  EXPECT_TRUE(suite.scenes[0].file.empty());
  EXPECT_EQ(file_of(suite.scenes[1], ""), home / "b.json");
  EXPECT_TRUE(suite.scenes[1].detectors.empty());
  EXPECT_EQ(file_of(suite.scenes[2], ""), home / "suites" / "c.ccr");
  EXPECT_EQ(suite.scenes[2].detectors, std::vector<std::string>{"e"});
  EXPECT_EQ(file_of(suite.scenes[3], ""), "/d.json");
  // ".." leads out of the folder that the file is in, by whatever link that was reached.
  scratch.write("elsewhere/deep/readme", "");
  std::filesystem::create_directory_symlink(home / "suites", home / "elsewhere" / "deep" / "link");
  EXPECT_EQ(load_suite(home / "elsewhere/deep/link/u.json").scenes[1].file, home / "b.json");
}

}  // namespace
}  // namespace contactcheck::scene
