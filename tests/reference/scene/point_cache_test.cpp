// PC2 and MDD: what is read, and every way in which a file can be wrong.
#include "reference/scene/point_cache.h"

#include <gmock/gmock.h>

#include <limits>

#include "tests/reference/scene/scratch.h"
#include "tests/support/cache_bytes.h"

namespace contactcheck::scene {
namespace {

using test::CacheSamples;
using test::float_bytes;
using test::mdd_bytes;
using test::pc2_bytes;
using test::Scratch;
using test::sentence_of;
using test::word_bytes;
using testing::HasSubstr;

const CacheSamples kSamples = {{Vec3(0, 0.5, -1), Vec3(1e-30, 2, 3)},
                               {Vec3(4, 5, 6), Vec3(-7, 8, 9)},
                               {Vec3(0.25, 0, 0), Vec3(1, 1, 1e30)}};

// Floats are all that a cache holds. (By way of memory: see rounded_scene.cpp.)
Vec3 rounded(const Vec3& v) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const volatile float stored = static_cast<float>(v[k]);
    out[k] = static_cast<double>(stored);
  }
  return out;
}

void expect_samples(const PointCache& cache) {
  ASSERT_EQ(cache.samples(), 3u);
  ASSERT_EQ(cache.points(), 2u);
  for (std::size_t s = 0; s < 3; ++s)
    for (std::size_t p = 0; p < 2; ++p)
      EXPECT_EQ(cache.sample(s)[p], rounded(kSamples[s][p])) << s << " " << p;
}

TEST(PointCache, GivesTheFloatsOfBothFormats) {
  const Scratch scratch;
  expect_samples(read_point_cache(scratch.write("a.pc2", pc2_bytes(kSamples))));
  expect_samples(read_point_cache(scratch.write("b.MDD", mdd_bytes(kSamples))));
}

struct Wrong {
  std::string name, file, bytes, sentence;
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

class WrongCache : public testing::TestWithParam<Wrong> {};

TEST_P(WrongCache, IsRefusedWithOneSentence) {
  const Scratch scratch;
  const Wrong& wrong = GetParam();
  const auto file = scratch.write(wrong.file, wrong.bytes);
  const std::string sentence = sentence_of([&] {
    const PointCache cache = read_point_cache(file);
    for (std::size_t s = 0; s < cache.samples(); ++s) cache.sample(s);
  });
  EXPECT_EQ(sentence, "point cache \"" + file.string() + "\" " + wrong.sentence);
}

std::string with(std::string bytes, std::size_t at, const std::string& value) {
  return bytes.replace(at, value.size(), value);
}
std::string pc2_with(std::size_t at, const std::string& value) {
  return with(pc2_bytes(kSamples), at, value);
}
std::string mdd_with(std::size_t at, const std::string& value) {
  return with(mdd_bytes(kSamples), at, value);
}
std::string little(std::uint32_t value) { return word_bytes(value, false); }
std::string big(std::uint32_t value) { return word_bytes(value, true); }

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();
const std::string kPc2 = pc2_bytes(kSamples), kMdd = mdd_bytes(kSamples);

std::string name_of_wrong(const testing::TestParamInfo<Wrong>& test) { return test.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Pc2, WrongCache,
    testing::Values(
        Wrong{"Empty", "a.pc2", "", "is empty."},
        Wrong{"OtherMagic", "a.pc2", pc2_with(0, "p"),
              "is no PC2 file: it does not begin with POINTCACHE2 and a zero byte."},
        Wrong{"MagicWithoutZero", "a.pc2", pc2_with(11, " "),
              "is no PC2 file: it does not begin with POINTCACHE2 and a zero byte."},
        Wrong{"Mdd", "a.pc2", kMdd,
              "is no PC2 file: it does not begin with POINTCACHE2 and a zero byte."},
        Wrong{"HeaderCut", "a.pc2", kPc2.substr(0, 31), "has 31 bytes; its header alone takes 32."},
        Wrong{"Version", "a.pc2", pc2_with(12, little(2)), "has version 2; only 1 is known."},
        Wrong{"StartNan", "a.pc2", pc2_with(20, float_bytes(kNan, false)),
              "has a first frame that is not a finite number."},
        Wrong{"RateInfinite", "a.pc2", pc2_with(24, float_bytes(kInfinite, false)),
              "has a number of frames per sample that is not a finite number."},
        Wrong{"NoPoints", "a.pc2", pc2_with(16, little(0)),
              "claims 0 points; it must have at least 1."},
        Wrong{"NegativePoints", "a.pc2", pc2_with(16, little(0xffffffff)),
              "claims -1 points; it must have at least 1."},
        Wrong{"NoSamples", "a.pc2", pc2_with(28, little(0)),
              "claims 0 samples; it must have at least 1."},
        Wrong{"NegativeSamples", "a.pc2", pc2_with(28, little(0x80000000)),
              "claims -2147483648 samples; it must have at least 1."},
        Wrong{"TooManySamples", "a.pc2", pc2_with(28, little(4)),
              "claims 4 samples of 2 points, but has only 3 of them in its 104 bytes."},
        Wrong{"LyingCounts", "a.pc2",
              with(pc2_with(16, little(0x7fffffff)), 28, little(0x7fffffff)),
              "claims 2147483647 samples of 2147483647 points, but has only 0 of them in its 104 "
              "bytes."},
        Wrong{"Cut", "a.pc2", kPc2.substr(0, kPc2.size() - 1),
              "claims 3 samples of 2 points, but has only 2 of them in its 103 bytes."},
        Wrong{"Trailing", "a.pc2", kPc2 + "abc",
              "has 3 bytes more than its 3 samples of 2 points."},
        Wrong{"Nan", "a.pc2", pc2_with(32 + 24 + 12 + 4, float_bytes(kNan, false)),
              "sample 1, point 1: its y is not a finite number."},
        Wrong{"Infinite", "a.pc2", pc2_with(32 + 48 + 8, float_bytes(-kInfinite, false)),
              "sample 2, point 0: its z is not a finite number."}),
    name_of_wrong);

INSTANTIATE_TEST_SUITE_P(
    Mdd, WrongCache,
    testing::Values(
        Wrong{"HeaderCut", "a.mdd", kMdd.substr(0, 7), "has 7 bytes; its header alone takes 8."},
        Wrong{"Pc2", "a.mdd", kPc2, "claims 1347373390 samples, more than its 104 bytes can hold."},
        Wrong{"NoSamples", "a.mdd", mdd_with(0, big(0)),
              "claims 0 samples; it must have at least 1."},
        Wrong{"NegativeSamples", "a.mdd", mdd_with(0, big(0xfffffffe)),
              "claims -2 samples; it must have at least 1."},
        Wrong{"NoPoints", "a.mdd", mdd_with(4, big(0)),
              "claims 0 points; it must have at least 1."},
        Wrong{"NegativePoints", "a.mdd", mdd_with(4, big(0x80000001)),
              "claims -2147483647 points; it must have at least 1."},
        Wrong{"LittleEndian", "a.mdd", mdd_with(4, little(2)),
              "claims 3 samples of 33554432 points, but has only 0 of them in its 92 bytes."},
        Wrong{"TimesAlone", "a.mdd", kMdd.substr(0, 20),
              "claims 3 samples of 2 points, but has only 0 of them in its 20 bytes."},
        Wrong{"TimesCut", "a.mdd", kMdd.substr(0, 19),
              "claims 3 samples, more than its 19 bytes can hold."},
        Wrong{"TimeNan", "a.mdd", mdd_with(12, float_bytes(kNan, true)),
              "has a time of sample 1 that is not a finite number."},
        Wrong{"Cut", "a.mdd", kMdd.substr(0, kMdd.size() - 12),
              "claims 3 samples of 2 points, but has only 2 of them in its 80 bytes."},
        Wrong{"Trailing", "a.mdd", kMdd + std::string(12, '\0'),
              "has 12 bytes more than its 3 samples of 2 points."},
        Wrong{"Nan", "a.mdd", mdd_with(20, float_bytes(kNan, true)),
              "sample 0, point 0: its x is not a finite number."},
        Wrong{"OtherExtension", "a.abc", kMdd, "is neither .pc2 nor .mdd."}),
    name_of_wrong);

}  // namespace
}  // namespace contactcheck::scene
