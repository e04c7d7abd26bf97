#include "core/deform/recording.h"

#include <gmock/gmock.h>

#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <limits>

#include "core/types/check.h"
#include "tests/core/recording/recording_samples.h"

namespace contactcheck {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Bits, not values: -0.0 and 0.0 differ.
void expect_same_points(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  ASSERT_EQ(a.size(), b.size());
  if (a.empty()) return;  // memcmp may not be given null
  EXPECT_EQ(0, std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)));
}

void expect_same_shape(const BodyShape& a, const BodyShape& b) {
  expect_same_points(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.topology.solid, b.topology.solid);
  EXPECT_EQ(a.given.numbers, b.given.numbers);
  EXPECT_EQ(a.given.dropped, b.given.dropped);
  ASSERT_EQ(a.lattice.has_value(), b.lattice.has_value());
  if (a.lattice) {
    EXPECT_EQ(a.lattice->lines, b.lattice->lines);
    EXPECT_EQ(a.lattice->cells, b.lattice->cells);
    EXPECT_EQ(a.lattice->nodes, b.lattice->nodes);
    EXPECT_EQ(a.lattice->cell_nodes, b.lattice->cell_nodes);
  }
  EXPECT_EQ(a.embedding.home_cell, b.embedding.home_cell);
  expect_same_points(a.embedding.local, b.embedding.local);
  EXPECT_EQ(a.embedding.label_begin, b.embedding.label_begin);
  EXPECT_EQ(a.embedding.label_cells, b.embedding.label_cells);
  EXPECT_EQ(a.embedding.cell_order, b.embedding.cell_order);
  EXPECT_EQ(a.embedding.cell_begin, b.embedding.cell_begin);
  EXPECT_EQ(a.embedding.sorted_local, b.embedding.sorted_local);
}

TEST(Recording, RoundTripKeepsEveryBit) {
  const Recording in = sample_recording();
  const Recording out = recording_of(bytes_of(in));
  EXPECT_EQ(out.scene, in.scene);
  EXPECT_EQ(out.time_step, in.time_step);
  ASSERT_EQ(out.bodies.size(), 3u);
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_EQ(out.bodies[b].name, in.bodies[b].name);
    expect_same_shape(*out.bodies[b].shape, *in.bodies[b].shape);
  }
  ASSERT_EQ(out.frames.size(), 2u);
  for (std::size_t f = 0; f < 2; ++f) {
    ASSERT_EQ(out.frames[f].size(), 3u);
    for (std::size_t b = 0; b < 3; ++b) expect_same_points(out.frames[f][b], in.frames[f][b]);
  }
}

TEST(Recording, RewritingGivesTheSameFile) {
  const std::string first = bytes_of(sample_recording());
  EXPECT_EQ(bytes_of(recording_of(first)), first);
}

TEST(Recording, ReplacesAnOlderFileAndLeavesNoOther) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "a.ccr";
  write_recording(file, sample_recording());
  write_recording(file, bare_recording());
  EXPECT_EQ(read_recording(file).scene, "flag");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Recording, SharedShapesStayShared) {
  const Recording out = recording_of(bytes_of(sample_recording()));
  EXPECT_EQ(out.bodies[0].shape, out.bodies[2].shape);
  EXPECT_NE(out.bodies[0].shape, out.bodies[1].shape);
}

TEST(Recording, EqualShapesOfTwoObjectsBecomeOne) {
  Recording in = bare_recording();
  in.bodies.push_back({"twin", make_bare_shape(one_triangle())});
  in.frames[0].push_back(in.frames[0][0]);
  ASSERT_NE(in.bodies[0].shape, in.bodies[1].shape);
  const Recording out = recording_of(bytes_of(in));
  EXPECT_EQ(out.bodies[0].shape, out.bodies[1].shape);
}

TEST(Recording, ShapesThatDifferInTheLatticeAloneStayTwo) {
  const TriangleMesh mesh = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1));
  Recording in;
  in.scene = "pair";
  in.bodies = {{"coarse", make_shape(mesh, {1, 1, 1})}, {"fine", make_shape(mesh, {2, 2, 2})}};
  in.frames = {
      {in.bodies[0].shape->lattice->rest_nodes(), in.bodies[1].shape->lattice->rest_nodes()}};
  const Recording out = recording_of(bytes_of(in));
  EXPECT_NE(out.bodies[0].shape, out.bodies[1].shape);
}

TEST(Recording, KeepsLevelsAndWeldedMeshes) {
  // Two triangles along an open seam.
  TriangleMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                   Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}};
  const auto open = make_bare_shape(mesh);
  Recording recording = bare_recording();
  recording.bodies = {{"open", open}, {"welded", welded(*open)}};
  recording.frames = {{mesh.vertices, mesh.vertices}};
  recording.levels = {Level::kBody, Level::kSelfEdge};
  const Recording read = recording_of(bytes_of(recording));
  EXPECT_EQ(read.levels, recording.levels);
  ASSERT_EQ(read.bodies.size(), 2u);
  EXPECT_NE(read.bodies[0].shape, read.bodies[1].shape);
  EXPECT_TRUE(read.bodies[0].shape->welded.empty());
  EXPECT_EQ(read.bodies[1].shape->welded, (std::vector<Triangle>{{0, 1, 2}, {1, 5, 2}}));
}

// A box in a lattice and a bare one, with a vertex that no triangle uses before the fourth.
TriangleMesh strewn_box() {
  TriangleMesh mesh = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1));
  mesh.vertices.insert(mesh.vertices.begin() + 3, Vec3(40, 0, 0));
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v += v < 3 ? 0 : 1;
  return mesh;
}

TEST(Recording, KeepsTheNumbersOfVerticesWhereSomeWereDropped) {
  Recording in;
  in.scene = "strewn";
  in.bodies = {{"bare", make_bare_shape(strewn_box())},
               {"cells", make_shape(strewn_box(), {2, 3, 2})}};
  in.frames = {{in.bodies[0].shape->mesh.vertices, in.bodies[1].shape->lattice->rest_nodes()}};
  const Recording out = recording_of(bytes_of(in));
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(out.bodies[b].shape->given.dropped, 1u);
    expect_same_shape(*out.bodies[b].shape, *in.bodies[b].shape);
    expect_same_points(out.frames[0][b], in.frames[0][b]);
  }
  EXPECT_EQ(bytes_of(out), bytes_of(in));
}

// As other programs and older versions write it: with the vertex, wherever it is.
TEST(Recording, DropsVerticesThatNoTriangleUses) {
  const auto with_stray = [](BodyShape shape) {
    shape.mesh = strewn_box();
    if (!shape.lattice) return std::make_shared<const BodyShape>(shape);
    shape.mesh.vertices[3] = shape.mesh.vertices[2];
    shape.embedding.home_cell.insert(shape.embedding.home_cell.begin() + 3,
                                     shape.embedding.home_cell[2]);
    shape.embedding.local.insert(shape.embedding.local.begin() + 3, shape.embedding.local[2]);
    return std::make_shared<const BodyShape>(shape);
  };
  const TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1));
  const auto bare = make_bare_shape(box), cells = make_shape(box, {2, 3, 2});
  Recording in;
  in.scene = "strewn";
  in.bodies = {{"bare", with_stray(*bare)}, {"cells", with_stray(*cells)}};
  std::vector<Vec3> moved = strewn_box().vertices;
  for (Vec3& v : moved) v.z() += 2.0;
  in.frames = {{moved, cells->lattice->rest_nodes()}};
  const Recording out = recording_of(bytes_of(in));
  expect_same_points(out.bodies[0].shape->mesh.vertices, box.vertices);
  expect_same_points(out.bodies[1].shape->embedding.local, cells->embedding.local);
  EXPECT_EQ(out.bodies[1].shape->embedding.sorted_local, cells->embedding.sorted_local);
  for (std::size_t b = 0; b < 2; ++b)
    EXPECT_EQ(out.bodies[b].shape->given.numbers,
              (std::vector<std::uint32_t>{0, 1, 2, 4, 5, 6, 7, 8}));
  moved.erase(moved.begin() + 3);
  expect_same_points(out.frames[0][0], moved);
}

TEST(Recording, WithoutFramesIsKept) {
  Recording in = bare_recording();
  in.frames.clear();
  EXPECT_TRUE(recording_of(bytes_of(in)).frames.empty());
}

// The whole file of a bare triangle, assembled from the description in fixtures/README.md.
TEST(Recording, HasTheDocumentedBytes) {
  std::string shape = u64_bytes(3);
  for (double x : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.1, 0.0}) shape += f64_bytes(x);
  shape += u64_bytes(1) + u32_bytes(0) + u32_bytes(1) + u32_bytes(2) + std::string(4, '\0');
  shape += u64_bytes(0);
  std::string file(
      "\x89"
      "CCR\r\n\x1a\n",
      8);
  file += u64_bytes(1) + u64_bytes(0) + f64_bytes(0.5);
  file += u64_bytes(4) + "flag" + std::string(4, '\0');
  file += u64_bytes(1) + u64_bytes(reference_hash(shape)) + shape;
  file += u64_bytes(1) + u64_bytes(5) + "cloth" + std::string(3, '\0') + u64_bytes(0);
  file += u64_bytes(1);
  for (double x : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.1, 0.0}) file += f64_bytes(x);
  file += u64_bytes(0);
  seal(file);
  EXPECT_EQ(bytes_of(bare_recording()), file);
}

TEST(Recording, UnwritableFolderIsNamed) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "missing" / "a.ccr";
  EXPECT_THAT(
      [&] { write_recording(file, bare_recording()); },
      ThrowsMessage<InputError>(AllOf(HasSubstr(file.string()), HasSubstr("No such file"))));
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(Recording, FailedRenameLeavesNothing) {
  const ScratchFolder folder;
  const std::filesystem::path taken = folder.path() / "a.ccr";
  std::filesystem::create_directories(taken / "inside");
  EXPECT_THAT([&] { write_recording(taken, bare_recording()); },
              ThrowsMessage<InputError>(HasSubstr(taken.string())));
  EXPECT_EQ(folder.file_count(), 1u);
}

// Limits the size of files this process may write, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limited = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_ = {};
  void (*handler_)(int) = nullptr;
};

TEST(Recording, FailureHalfWayKeepsTheOlderFileAndNothingElse) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "a.ccr";
  write_recording(file, bare_recording());
  {
    const FileSizeLimit limit(100);
    EXPECT_THAT([&] { write_recording(file, sample_recording()); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("cannot write"), HasSubstr("a.ccr"))));
  }
  EXPECT_EQ(read_recording(file).scene, "flag");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Recording, NonFiniteNodeIsNamedAndNothingWritten) {
  const ScratchFolder folder;
  Recording in = sample_recording();
  in.frames[1][2][3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { write_recording(folder.path() / "a.ccr", in); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("node 3"), HasSubstr("\"box b\""), HasSubstr("frame 1"))));
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(Recording, NamesThatEscapeTheFolderAreRefused) {
  const ScratchFolder folder;
  for (const char* scene : {"../up", "a\\b", "..", ".", "", "line\nbreak", "\xff", "\xc0\x80"}) {
    Recording in = bare_recording();
    in.scene = scene;
    EXPECT_THROW(write_recording(folder.path() / "a.ccr", in), InputError) << scene;
  }
}

TEST(Recording, MissingFileAndFolderAreRefused) {
  const ScratchFolder folder;
  EXPECT_THAT([&] { read_recording(folder.path() / "none.ccr"); },
              ThrowsMessage<InputError>(HasSubstr("none.ccr\" does not exist.")));
  EXPECT_THAT([&] { read_recording(folder.path()); },
              ThrowsMessage<InputError>(HasSubstr("\" is a folder, not a regular file.")));
}

}  // namespace
}  // namespace contactcheck
