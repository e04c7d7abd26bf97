// check: frames of a simulation, clean and with contacts.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/cache_bytes.h"
#include "tests/support/files.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"

namespace contactcheck::cli {
namespace {

using nlohmann::json;
using test::contactcheck_program;
using test::Outcome;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

// A box of 1 m rests; another one comes from the right, sinks 0.1 m into it in frame 3 and leaves.
class Check : public testing::Test {
 protected:
  Check() {
    const std::vector<double> gaps = {0.5, 0.2, 0.01, -0.1, 0.3};
    for (std::size_t f = 0; f < gaps.size(); ++f) {
      const Vec3 corner(1.0 + gaps[f], 0.25, 0.25);
      scratch_.write("moving_" + std::to_string(8 + f) + ".obj",
                     test::obj_text(test::box_mesh(corner, corner + Vec3(0.5, 0.5, 0.5), 2)));
    }
    scratch_.write("rest.obj", test::obj_text(test::unit_box_mesh(2)));
  }

  std::string in(const std::string& name) const { return (scratch_.folder() / name).string(); }
  // In any order, as a shell gives them: 10 before 8.
  Words frames() const {
    return {in("moving_10.obj"), in("moving_11.obj"), in("moving_12.obj"), in("moving_8.obj"),
            in("moving_9.obj")};
  }
  Outcome check(Words words, const Words& more = {}) const {
    words.insert(words.begin(), "check");
    words.insert(words.end(), {"--out", in("out")});
    words.insert(words.end(), more.begin(), more.end());
    return contactcheck_program(words);
  }
  Outcome check_both(const Words& more = {}) const {
    Words words = frames();
    words.push_back(in("rest.obj"));
    return check(words, more);
  }

  const test::Scratch scratch_;
};

TEST_F(Check, NamesTheFrameTheTrianglesAndTheDepth) {
  const Outcome outcome = check_both();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, ContainsRegex("moving_'?\\*\\.obj\n"));
  EXPECT_THAT(outcome.out, HasSubstr("5 frames\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nframe 3 (moving_11.obj)\n  moving and rest: "));
  EXPECT_THAT(outcome.out, HasSubstr(" pairs of triangles, first "));
  EXPECT_THAT(outcome.out, HasSubstr(", 100 mm deep\n"));
  EXPECT_THAT(outcome.out,
              HasSubstr("1 of 5 frames has a contact that is not allowed, the first is frame 3"));
  EXPECT_THAT(outcome.out, ContainsRegex("report\\.(html|md) shows it\n"));
  EXPECT_TRUE(std::filesystem::exists(in("out/report.md")));
  EXPECT_TRUE(std::filesystem::exists(in("out/frame-3.ccr")));
}

TEST_F(Check, FindsNothingInCleanFrames) {
  const Outcome alone = check(frames());
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_THAT(alone.out, HasSubstr("no frame has a contact that is not allowed"));
  EXPECT_FALSE(std::filesystem::exists(in("out/report.md")));
}

TEST_F(Check, AllowsWhatItIsTold) {
  EXPECT_EQ(check_both({"--allow", "contact"}).exit_code, 0);
  EXPECT_EQ(check_both({"--allow", "self"}).exit_code, 1);
  EXPECT_EQ(check_both({"--allow", "depth=0.11"}).exit_code, 0);
  EXPECT_EQ(check_both({"--allow", "depth=0.09"}).exit_code, 1);
  EXPECT_THAT(check_both({"--allow", "depth=nan"}).err, HasSubstr("metres from 0 to 1e9"));
  EXPECT_THAT(check_both({"--allow", "all"}).err, HasSubstr("not one of contact, self, depth"));
  EXPECT_THAT(check_both({"--allow", "contact", "--allow", "self"}).err,
              HasSubstr("leave nothing to be checked"));
}

// Between open surfaces no depth is defined, so none is allowed.
TEST_F(Check, AllowsNoDepthBetweenOpenSurfaces) {
  const auto plate = [](double z, double tilt) {
    return test::triangle_mesh({0, 0, z}, {1, 0, z + tilt}, {0, 1, z});
  };
  scratch_.write("a.obj", test::obj_text(plate(0.0, 0.0)));
  scratch_.write("b.obj", test::obj_text(plate(-0.1, 0.3)));
  const Outcome outcome = check({in("a.obj"), in("b.obj")}, {"--allow", "depth=10"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("a and b: 1 pair of triangles, first 0 and 0\n"));
}

TEST_F(Check, SeesABodyInsideAnother) {
  scratch_.write("inner.obj", test::obj_text(test::box_mesh({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}, 1)));
  const Outcome outcome = check({in("rest.obj"), in("inner.obj")});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("rest and inner: one is inside the other, 400 mm deep\n"));
}

// Two triangles side by side, each with vertices of its own along the seam.
TEST_F(Check, WeldsSeamsWhereAskedTo) {
  const TriangleMesh seam = {
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)},
      {{0, 1, 2}, {3, 4, 5}}};
  scratch_.write("seam.obj", test::obj_text(seam));
  const Outcome open = check({in("seam.obj")});
  EXPECT_EQ(open.exit_code, 1) << open.err;
  EXPECT_THAT(open.out, HasSubstr("seam with itself: 1 pair of triangles, first 0 and 1 "
                                  "(1 without a shared vertex)\n"));
  EXPECT_EQ(check({in("seam.obj")}, {"--weld"}).exit_code, 0);

  TriangleMesh torn = seam;
  torn.vertices[3].z() = 0.25;
  scratch_.write("torn_0.obj", test::obj_text(seam));
  scratch_.write("torn_1.obj", test::obj_text(torn));
  const Outcome apart = check({in("torn_0.obj"), in("torn_1.obj")}, {"--weld"});
  EXPECT_EQ(apart.exit_code, 2);
  EXPECT_THAT(apart.err, HasSubstr("frame 1: vertices 1 and 3 of body \"torn\" are welded and come "
                                   "apart"));
}

TEST_F(Check, ReadsPointCaches) {
  const TriangleMesh ball = test::sphere_mesh({3, 0.5, 0.5}, 0.5, 3);
  std::vector<std::vector<Vec3>> samples(3, ball.vertices);
  for (Vec3& vertex : samples[1]) vertex.x() -= 1.75;
  scratch_.write("ball.obj", test::obj_text(ball));
  scratch_.write("ball.pc2", test::pc2_bytes(samples));
  scratch_.write("ball.mdd", test::mdd_bytes(samples));
  for (const std::string cache : {"ball.pc2", "ball.mdd"}) {
    const Outcome outcome = check({in("ball.obj"), in(cache), in("rest.obj")});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("3 frames\n\nframe 1\n  ball and rest: ")) << cache;
    EXPECT_THAT(outcome.out, HasSubstr("1 of 3 frames has a contact")) << cache;
  }
}

// A vertex of n triangles has n (n - 1) / 2 pairs of neighbours: never a stall.
TEST_F(Check, RefusesAVertexOfTooManyTriangles) {
  TriangleMesh fan;
  fan.vertices.assign(10'002, Vec3::Zero());
  for (std::uint32_t i = 1; i < fan.vertices.size(); ++i) fan.vertices[i] = {1.0, 1e-4 * i, 0.0};
  for (std::uint32_t i = 0; i < 10'000; ++i) fan.triangles.push_back({0, i + 1, i + 2});
  scratch_.write("fan.obj", test::obj_text(fan));
  const Outcome outcome = check({in("fan.obj")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("self-contact of body \"fan\": its triangles share a vertex "
                                     "in 50004999 pairs (vertex 0 is in 10000 triangles)"));
  EXPECT_THAT(contactcheck_program(
                  {"check", in("fan.obj"), in("rest.obj"), "--allow", "self", "--out", in("out")})
                  .exit_code,
              1);
}

TEST_F(Check, PutsWhatItFoundAtTheHeadOfThePage) {
  std::filesystem::create_directory(in("sheet"));
  const std::string sheet = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv .2 .2 -1\nv .2 .2 1\n";
  const std::string faces = "f 1 2 3\nf 4 5 6\n";
  scratch_.write("sheet/frame_1.obj", sheet + "v 2 2 1\n" + faces);
  scratch_.write("sheet/frame_2.obj", sheet + "v .2 .2 0\n" + faces);
  const Words files = {in("sheet/frame_1.obj"), in("sheet/frame_2.obj")};
  const Outcome outcome = check(files, {"--allow", "contact"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const json results = json::parse(test::text_of(in("out/results.json")));
  EXPECT_EQ(results.at("finding").at("title"), "2 of 2 frames have a contact that is not allowed");
  EXPECT_EQ(results.at("finding").at("first"),
            "frame 0 (frame_1.obj), sheet with itself: 1 pair of triangles, first 0 and 1 (1 "
            "without a shared vertex)");
  for (const json& run : results.at("runs")) EXPECT_FALSE(run.at("levels").contains("triangle"));
  EXPECT_THAT(check(files, {"--allow", "self"}).err,
              HasSubstr("--allow self leaves nothing to be checked of one body"));
}

TEST_F(Check, SpeaksToPrograms) {
  const Outcome outcome = check_both({"--json-lines"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  std::vector<json> events;
  std::size_t at = 0;
  while (at < outcome.out.size()) {
    const std::size_t end = outcome.out.find('\n', at);
    events.push_back(json::parse(outcome.out.substr(at, end - at)));
    at = end + 1;
  }
  EXPECT_EQ(events.front().at("event"), "start");
  EXPECT_EQ(events.front().at("frames"), 5);
  std::vector<json> bad;
  for (const json& event : events)
    if (event.at("event") == "frame") bad.push_back(event);
  ASSERT_EQ(bad.size(), 1u);
  EXPECT_EQ(bad[0].at("frame"), 3);
  EXPECT_EQ(bad[0].at("file"), "moving_11.obj");
  EXPECT_EQ(bad[0].at("contacts")[0].at("bodies"), json({"moving", "rest"}));
  EXPECT_NEAR(bad[0].at("contacts")[0].at("depth").get<double>(), 0.1, 1e-9);
  EXPECT_EQ(events.back().at("event"), "end");
  EXPECT_EQ(events.back().at("bad_frames"), 1);
  EXPECT_EQ(events.back().at("exit_code"), 1);
}

TEST_F(Check, RefusesWhatItCannotRead) {
  EXPECT_THAT(check({in("moving_8.obj"), in("moving_10.obj"), in("moving_11.obj")}).err,
              HasSubstr("go from 10 to 11; they must go on as they begin"));
  EXPECT_THAT(check({in("gone.pc2")}).err,
              HasSubstr("is a point cache; the mesh that it moves is named before it"));
  const Outcome gone = check({in("gone.obj")});
  EXPECT_EQ(gone.exit_code, 2);
  EXPECT_THAT(gone.err, HasSubstr("gone.obj"));
}

}  // namespace
}  // namespace contactcheck::cli
