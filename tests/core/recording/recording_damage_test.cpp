// Damaged recordings: cut, flipped, with absurd counts, and well-sealed files whose content is
// inconsistent. The reader answers each with InputError or with a recording that can be used.
#include <gmock/gmock.h>

#include <array>
#include <functional>
#include <limits>
#include <optional>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "tests/core/recording/allocation_watch.h"
#include "tests/core/recording/recording_samples.h"

namespace contactcheck {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Offsets of a file made from bare_recording() (see Recording.HasTheDocumentedBytes).
constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kTimeStepAt = 24;
constexpr std::size_t kSceneLengthAt = 32;
constexpr std::size_t kShapeCountAt = 48;
constexpr std::size_t kShapeHashAt = 56;
constexpr std::size_t kVertexCountAt = 64;
constexpr std::size_t kTriangleCountAt = 144;
constexpr std::size_t kLatticeFlagAt = 168;
constexpr std::size_t kBodyCountAt = 176;
constexpr std::size_t kNameLengthAt = 184;
constexpr std::size_t kShapeNumberAt = 200;
constexpr std::size_t kFrameCountAt = 208;

void expect_refused(const std::string& bytes, const std::string& because) {
  EXPECT_THAT([&] { recording_of(bytes); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("case.ccr"), HasSubstr(because))));
}

// Reads; a recording that is accepted must be usable to the last index.
bool accepted(const std::string& bytes) {
  std::optional<Recording> recording;
  try {
    recording = recording_of(bytes);
  } catch (const InputError&) {
    return false;
  }
  for (const auto& frame : recording->frames) {
    EXPECT_EQ(frame.size(), recording->bodies.size());
    for (std::size_t b = 0; b < frame.size(); ++b) {
      const BodyShape& shape = *recording->bodies[b].shape;
      EXPECT_EQ(frame[b].size(), shape.node_count());
      std::vector<Vec3> vertices(shape.mesh.vertices.size());
      map_body(shape, frame[b], vertices);
    }
  }
  return true;
}

// A bare recording changed at one place, with the hashes made right again.
std::string bare_with(std::size_t at, std::uint64_t value) {
  std::string bytes = bytes_of(bare_recording());
  set_u64(bytes, at, value);
  set_u64(bytes, kShapeHashAt,
          reference_hash(bytes.substr(kVertexCountAt, kBodyCountAt - kVertexCountAt)));
  seal(bytes);
  return bytes;
}

// The sample recording with its first shape replaced by a changed copy; the writer does not look
// into shapes, so hashes are right and the reader's own checks are met.
std::string sample_with(const std::function<void(BodyShape&)>& change) {
  Recording recording = sample_recording();
  const auto changed = std::make_shared<BodyShape>(*recording.bodies[0].shape);
  change(*changed);
  recording.bodies[0].shape = changed;
  for (auto& frame : recording.frames) frame[0].resize(changed->node_count(), Vec3::Zero());
  return bytes_of(recording);
}

TEST(RecordingDamage, EveryTruncationIsRefused) {
  const std::string whole = bytes_of(sample_recording());
  ASSERT_LT(whole.size(), 20000u);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(recording_of(whole.substr(0, size)), InputError) << size;
  }
}

TEST(RecordingDamage, EverySealedTruncationIsRefused) {
  const std::string whole = bytes_of(sample_recording());
  for (std::size_t size = 32; size < whole.size(); ++size) {
    std::string cut = whole.substr(0, size);
    seal(cut);
    EXPECT_THROW(recording_of(cut), InputError) << size;
  }
}

TEST(RecordingDamage, EveryFlippedByteIsRefused) {
  const std::string whole = bytes_of(sample_recording());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << at % 8));
    EXPECT_THROW(recording_of(flipped), InputError) << at;
  }
}

TEST(RecordingDamage, SealedFlipsAreRefusedOrUsable) {
  const std::string whole = bytes_of(sample_recording());
  std::size_t usable = 0, refused = 0;
  constexpr std::array kFlips = {0x01, 0x80, 0xff};
  for (std::size_t at = 0; at + 8 < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ kFlips[at % 3]);
    seal(flipped);
    ++(accepted(flipped) ? usable : refused);
  }
  // Node positions and letters of names may change; shapes are under their own hash.
  EXPECT_GT(usable, 100u);
  EXPECT_GT(refused, 1000u);
}

TEST(RecordingDamage, SealedFlipsOfAShapeAreRefusedOrUsable) {
  const std::string whole = bytes_of(bare_recording());
  std::size_t usable = 0, refused = 0;
  for (std::size_t at = kVertexCountAt; at < kBodyCountAt; at += 1) {
    for (int flip = 1; flip < 256; flip += flip) {
      std::uint64_t word = 0;
      const std::size_t begin = at / 8 * 8;
      for (int i = 7; i >= 0; --i) word = word << 8 | static_cast<unsigned char>(whole[begin + i]);
      word ^= static_cast<std::uint64_t>(flip) << (at % 8 * 8);
      ++(accepted(bare_with(begin, word)) ? usable : refused);
    }
  }
  EXPECT_GT(usable, 100u);
  EXPECT_GT(refused, 100u);
}

TEST(RecordingDamage, AbsurdCountsAreRefusedWithoutAllocating) {
  for (std::size_t at : {kSceneLengthAt, kShapeCountAt, kVertexCountAt, kTriangleCountAt,
                         kBodyCountAt, kNameLengthAt, kFrameCountAt}) {
    for (std::uint64_t count :
         {std::uint64_t{1000}, std::uint64_t{1} << 31, (std::uint64_t{1} << 32) - 2,
          std::uint64_t{1} << 61, ~std::uint64_t{0}, ~std::uint64_t{0} / 24}) {
      const std::string bytes = bare_with(at, count);
      reset_largest_allocation();
      expect_refused(bytes, std::to_string(count));
      EXPECT_LT(largest_allocation(), 100000u) << "count " << count << " at byte " << at;
    }
  }
}

TEST(RecordingDamage, WrongHeaderIsNamed) {
  std::string text = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_refused(text, "not a recording");
  expect_refused("", "not a recording");
  expect_refused(bare_with(kVersionAt, 3), "version 3 is not known");
  std::string longer = bytes_of(bare_recording()) + "x";
  expect_refused(longer, "was written with " + std::to_string(longer.size() - 1));
}

TEST(RecordingDamage, BytesAfterTheLastFrameAreRefused) {
  std::string bytes = bytes_of(bare_recording());
  bytes.insert(bytes.size() - 8, 16, '\0');
  seal(bytes);
  expect_refused(bytes, "16 bytes too many");
}

TEST(RecordingDamage, NonZeroPaddingIsRefused) {
  std::string bytes = bytes_of(bare_recording());
  bytes[kSceneLengthAt + 8 + 5] = 'x';
  seal(bytes);
  expect_refused(bytes, "other than zero");
}

TEST(RecordingDamage, ShapeHashMustFit) {
  std::string bytes = bytes_of(bare_recording());
  bytes[kShapeHashAt] ^= 1;
  seal(bytes);
  expect_refused(bytes, "does not have the hash it is keyed by");
}

TEST(RecordingDamage, BareRecordingNamesWhatIsWrong) {
  const std::uint64_t nan_bits = 0x7ff8000000000000, infinity_bits = 0xfff0000000000000;
  expect_refused(bare_with(kTimeStepAt, nan_bits),
                 "not a finite number in the time step (at byte 24)");
  expect_refused(bare_with(kTimeStepAt, 0xbff0000000000000), "the time step is negative");
  expect_refused(bare_with(kVertexCountAt + 8, infinity_bits),
                 "not a finite number in the vertices");
  expect_refused(bare_with(kTriangleCountAt + 8, 0x300000000), "index-out-of-range");
  expect_refused(bare_with(kLatticeFlagAt, 2), "the lattice flag is not in 0 to 1");
  expect_refused(bare_with(kShapeNumberAt, 1), "shape number 1 of 1");
  expect_refused(bare_with(kFrameCountAt + 16, nan_bits), "not a finite number in the nodes");
  expect_refused(bare_with(kNameLengthAt + 8, 0xff), "not valid UTF-8");
  expect_refused(bare_with(kSceneLengthAt + 8, 0x2f2f2f2f), "file name");
}

TEST(RecordingDamage, RecordingWithoutBodiesIsRefused) {
  std::string bytes = bytes_of(bare_recording());
  set_u64(bytes, kBodyCountAt, 0);
  bytes.erase(kNameLengthAt, kFrameCountAt - kNameLengthAt);
  seal(bytes);
  expect_refused(bytes, "no body");
}

TEST(RecordingDamage, UnchangedSampleIsAccepted) {
  EXPECT_TRUE(accepted(sample_with([](BodyShape&) {})));
}

TEST(RecordingDamage, BrokenGridIsRefused) {
  expect_refused(sample_with([](BodyShape& s) { s.lattice->lines[1] = {0.0}; }),
                 "fewer than two lines");
  expect_refused(sample_with([](BodyShape& s) { s.lattice->lines[2][1] = s.lattice->lines[2][0]; }),
                 "lines of axis 2 do not increase");
  expect_refused(sample_with([](BodyShape& s) {
                   s.lattice->lines[0][0] = -std::numeric_limits<double>::infinity();
                 }),
                 "not a finite number in the lattice lines");
  expect_refused(sample_with([](BodyShape& s) { s.lattice->cells[7][0] = 2; }),
                 "cell 7 lies outside the grid");
  expect_refused(sample_with([](BodyShape& s) { s.lattice->nodes.back()[2] = 3; }),
                 "outside the grid");
  expect_refused(
      sample_with([](BodyShape& s) { std::swap(s.lattice->cells[1], s.lattice->cells[2]); }),
      "cells do not ascend");
  expect_refused(
      sample_with([](BodyShape& s) { std::swap(s.lattice->nodes[0], s.lattice->nodes[9]); }),
      "nodes do not ascend");
  expect_refused(
      sample_with([](BodyShape& s) { s.lattice->cells.clear(), s.lattice->cell_nodes.clear(); }),
      "no cell");
}

TEST(RecordingDamage, BrokenCellNodesAreRefused) {
  expect_refused(sample_with([](BodyShape& s) { s.lattice->cell_nodes[3][5] = 27; }),
                 "corner 5 of cell 3");
  expect_refused(sample_with([](BodyShape& s) { s.lattice->cell_nodes[3][5] = 0; }),
                 "corner 5 of cell 3");
  expect_refused(sample_with([](BodyShape& s) {
                   std::swap(s.lattice->cell_nodes[0][0], s.lattice->cell_nodes[0][1]);
                 }),
                 "corner 0 of cell 0");
  const auto drop_last_cell = [](BodyShape& s) {
    s.lattice->cells.pop_back();
    s.lattice->cell_nodes.pop_back();
  };
  expect_refused(sample_with(drop_last_cell), "belongs to no cell");
}

TEST(RecordingDamage, BrokenEmbeddingIsRefused) {
  expect_refused(sample_with([](BodyShape& s) { s.embedding.home_cell[2] = 8; }),
                 "vertex 2 does not lie");
  expect_refused(sample_with([](BodyShape& s) { s.embedding.home_cell[2] ^= 1; }),
                 "vertex 2 does not lie");
  expect_refused(sample_with([](BodyShape& s) { s.embedding.local[4].z() = 1.5; }), "vertex 4");
  expect_refused(sample_with([](BodyShape& s) { s.embedding.local[4].x() = -1e-300; }), "vertex 4");
  expect_refused(sample_with([](BodyShape& s) { s.embedding.label_begin[0] = 1; }), "label starts");
  expect_refused(sample_with([](BodyShape& s) { s.embedding.label_begin.back() += 1; }),
                 "label starts");
  expect_refused(sample_with([](BodyShape& s) { s.embedding.label_begin[1] = 0; }), "label starts");
  expect_refused(sample_with([](BodyShape& s) { s.embedding.label_cells[0] = 9; }),
                 "label of triangle 0");
  expect_refused(sample_with([](BodyShape& s) {
                   std::swap(s.embedding.label_cells[0], s.embedding.label_cells[1]);
                 }),
                 "label of triangle 0");
}

// tests/core/deform/shape_check_test.cpp has the limits.
TEST(RecordingDamage, EmbeddingsThatContradictTheMeshAreRefused) {
  expect_refused(sample_with([](BodyShape& s) { s.embedding.local[4].x() = 0.5; }),
                 "local coordinates of vertex 4 are not those of its position");
  expect_refused(sample_with([](BodyShape& s) {
                   s.embedding.label_cells.pop_back();
                   --s.embedding.label_begin.back();
                 }),
                 "which its label does not name");
}

}  // namespace
}  // namespace contactcheck
