// What the fuzz targets rely on: that the corpus of triangles is hard, and that a recording whose
// content is damaged gets past its hashes once it is repaired.

#include <gtest/gtest.h>

#include <filesystem>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/fuzz/hard_pair.h"
#include "tests/fuzz/recording_repair.h"
#include "tests/support/files.h"

namespace contactcheck::test {
namespace {

std::filesystem::path corpus(const std::string& target) {
  return std::filesystem::path(CONTACTCHECK_FIXTURES) / "fuzz" / target;
}

std::vector<std::pair<TrianglePoints, TrianglePoints>> corpus_pairs() {
  std::vector<std::pair<TrianglePoints, TrianglePoints>> pairs;
  for (const auto& entry : std::filesystem::directory_iterator(corpus("triangles"))) {
    const std::string bytes = text_of(entry.path());
    const auto pair =
        hard_pair({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    EXPECT_TRUE(pair.has_value()) << entry.path();
    if (pair) pairs.push_back(*pair);
  }
  return pairs;
}

bool coplanar(const std::pair<TrianglePoints, TrianglePoints>& pair) {
  const auto& [p, q] = pair;
  for (const Vec3& corner : q)
    if (oracle::rational::orient3d(p[0], p[1], p[2], corner) != 0) return false;
  return true;
}

// One corner of the second triangle lies in the plane of the first, or so near that doubles without
// an error bound cannot tell.
bool plain_doubles_are_wrong(const std::pair<TrianglePoints, TrianglePoints>& pair) {
  const auto& [p, q] = pair;
  for (const Vec3& d : q) {
    const double determinant = (p[1] - p[0]).cross(p[2] - p[0]).dot(d - p[0]);
    const int sign = determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
    if (sign != oracle::rational::orient3d(p[0], p[1], p[2], d)) return true;
  }
  return false;
}

TEST(TriangleCorpus, HoldsContactsAndGapsMostOfThemHard) {
  const auto pairs = corpus_pairs();
  std::size_t meet = 0, flat = 0, wrong = 0;
  for (const auto& pair : pairs) {
    meet += oracle::rational::triangles_intersect(pair.first, pair.second);
    flat += coplanar(pair);
    wrong += plain_doubles_are_wrong(pair);
  }
  EXPECT_GE(meet, 6u);
  EXPECT_GE(pairs.size() - meet, 4u);
  EXPECT_GE(flat, 5u);
  EXPECT_GE(wrong, 3u);
}

TEST(HardPair, ReadsTheDocumentedOperations) {
  const std::uint8_t bytes[] = {
      0, 0, 8, 0, 0, 0, 255,        // (8, 0, -1)
      1, 1, 3, 4, 0, 2, 1,   2, 8,  // 3 * 2^4, then -0 and 1 of the table
      3, 0,                         // the first corner
      4, 0, 1, 1,                   // its y an ulp up
      5, 0, 1, 2,                   // half-way to the second
      7, 0, 0, 1,                   // the first, with the x of the second
  };
  const auto pair = hard_pair(bytes);
  ASSERT_TRUE(pair.has_value());
  EXPECT_EQ(pair->first[0], Vec3(8, 0, -1));
  EXPECT_EQ(pair->first[1], Vec3(48, -0.0, 1));
  EXPECT_EQ(pair->first[2], Vec3(8, 0, -1));
  EXPECT_EQ(pair->second[0], Vec3(8, 0x1p-1074, -1));
  EXPECT_EQ(pair->second[1], Vec3(28, 0, 0));
  EXPECT_EQ(pair->second[2], Vec3(48, 0, -1));
}

TEST(HardPair, SkipsWhatIsNotFinite) {
  const std::uint8_t bytes[] = {0, 3, 0x7f, 0xf0, 0, 0, 0, 0, 0, 0};
  EXPECT_FALSE(hard_pair(bytes).has_value());
}

TEST(RepairedRecording, GetsPastTheHashes) {
  const std::string whole = text_of(corpus("recording") / "one-triangle.ccr");
  EXPECT_EQ(repaired_recording(whole), whole);
  std::string damaged = whole;
  constexpr std::size_t kTimeStepAt = 24, kFirstVertexAt = 72;
  damaged[kTimeStepAt] = static_cast<char>(damaged[kTimeStepAt] ^ 1);
  damaged[kFirstVertexAt] = static_cast<char>(damaged[kFirstVertexAt] ^ 1);
  EXPECT_THROW(read_recording_bytes(damaged, "damaged.ccr"), InputError);
  const std::string repaired = repaired_recording(damaged);
  EXPECT_EQ(repaired[kFirstVertexAt], damaged[kFirstVertexAt]);
  EXPECT_NO_THROW(read_recording_bytes(repaired, "repaired.ccr"));
}

}  // namespace
}  // namespace contactcheck::test
