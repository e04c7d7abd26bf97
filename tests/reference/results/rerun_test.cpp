#include "reference/results/rerun.h"

#include <gtest/gtest.h>

namespace contactcheck::results {
namespace {

Results of_command(const std::string& command) {
  Results results;
  results.command = "contactcheck run " + command;
  results.plugins = {{"mine", "command", "python3 'my own.py'", "", ""},
                     {"fast", "library", "libfast.so", "", ""}};
  return results;
}

TEST(Rerun, NamesDetectorsFromOutsideAsTheCommandDid) {
  const Results results =
      of_command("a.json --detector-cmd x --detector 'a b/libfast.so:leaf=8' --quiet");
  EXPECT_EQ(detector_words(results, "mine"), "--detector-cmd 'python3 '\\''my own.py'\\'''");
  EXPECT_EQ(detector_words(results, "fast:leaf=8"), "--detector 'a b/libfast.so:leaf=8'");
  EXPECT_EQ(detector_words(results, "fast"), "--detector 'a b/libfast.so'");
  EXPECT_EQ(detector_words(results, "ffd-aabb:bounds=safe"), "--detector ffd-aabb:bounds=safe");
}

TEST(Rerun, NamesTheFolderOfTheResults) {
  EXPECT_EQ(out_folder(of_command("a.json --quiet")), "out");
  EXPECT_EQ(out_folder(of_command("a.json --out 'my own' --quiet")), "my own");
  EXPECT_EQ(out_folder(of_command("a.json --out=there")), "there");
}

TEST(Rerun, NamesAScenesFile) {
  const Results results = of_command("my/a.json --no-timing b.ccr default --out c.json");
  EXPECT_EQ(scene_words(results, "a"), "my/a.json");
  EXPECT_EQ(scene_words(results, "b"), "b.ccr");
  EXPECT_EQ(scene_words(results, "c"), "c") << "a folder of that name";
  EXPECT_EQ(scene_words(results, "pile"), "pile");
}

TEST(Rerun, NamesTheMeshesOfAScene) {
  EXPECT_EQ(scene_words(of_command("--mesh 'a b.obj' c.ply --no-timing"), "a_b-c-approach"),
            "'a b.obj' c.ply");
  const Results twisted = of_command("a.obj --quiet a.obj pile --motion=twist --size file");
  EXPECT_EQ(scene_words(twisted, "a-a-twist"), "a.obj a.obj --motion twist --size file");
  EXPECT_EQ(scene_words(twisted, "pile"), "pile");
}

}  // namespace
}  // namespace contactcheck::results
