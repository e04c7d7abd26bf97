// Meshes out of Debian packages. Tests of their content are skipped where a package is missing.
#include <gmock/gmock.h>
#include <zlib.h>

#include "core/types/mesh_topology.h"
#include "reference/mesh/datasets.h"
#include "reference/mesh/shapes.h"
#include "reference/mesh/tessellation.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::mesh {
namespace {

using test::Environment;
using test::Scratch;
using test::sentence_of;

constexpr const char* kArchive = "usr/share/doc/libcgal-demo/data.tar.gz";
constexpr const char* kTeapot = "usr/share/doc/povray/examples/advanced/teapot/teapot.inc";

bool installed(const char* path) {
  return sentence_of([&] { find_package_file(data_roots(), "", path); }).empty();
}

std::string tar_entry(const std::string& name, const std::string& content) {
  std::string header(512, '\0');
  header.replace(0, name.size(), name);
  char digits[16];
  std::snprintf(digits, sizeof digits, "%011o", static_cast<unsigned>(content.size()));
  header.replace(124, 11, digits);
  header.replace(148, 8, "        ");
  header[156] = '0';
  header.replace(257, 5, "ustar");
  unsigned sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  std::snprintf(digits, sizeof digits, "%06o", sum);
  header.replace(148, 6, digits);
  header[154] = '\0';
  std::string body = content;
  body.resize((content.size() + 511) / 512 * 512);
  return header + body;
}

std::filesystem::path write_tar_gz(const Scratch& scratch, const std::string& name,
                                   const std::string& tar) {
  const std::filesystem::path file = scratch.write(name, "");
  gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, tar.data(), static_cast<unsigned>(tar.size()));
  gzclose(out);
  return file;
}

const std::string kTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string small_tar() {
  return tar_entry("data/meshes/other.off", std::string(1000, 'x')) +
         tar_entry("data/meshes/tri.off", kTriangle) + std::string(1024, '\0');
}

TEST(TarArchive, FindsAMemberBehindOthers) {
  const Scratch scratch;
  const auto file = write_tar_gz(scratch, "a.tar.gz", small_tar());
  EXPECT_EQ(read_tar_member(file, "data/meshes/tri.off"), kTriangle);
  EXPECT_EQ(read_tar_member(file, "data/meshes/none.off"), std::nullopt);
}

TEST(TarArchive, DamageIsRefused) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& name, const std::string& tar) {
    const auto file = write_tar_gz(scratch, name, tar);
    return sentence_of([&] { read_tar_member(file, "data/meshes/tri.off"); });
  };
  std::string flipped = small_tar();
  flipped[3] ^= 1;
  std::string later = small_tar();
  later[512 + 1024 + 3] ^= 1;
  const std::string folder = scratch.folder().string();
  EXPECT_EQ(refusal("flip", flipped),
            "archive \"" + folder + "/flip\" cannot be read: Unrecognized archive format.");
  EXPECT_THAT(refusal("later", later),
              ::testing::StartsWith("archive \"" + folder + "/later\" is damaged or ends early: "));
  EXPECT_THAT(refusal("cut", small_tar().substr(0, 700)),
              ::testing::StartsWith("archive \"" + folder + "/cut\" is damaged or ends early: "));
  EXPECT_THAT(sentence_of([&] { read_tar_member(folder + "/none", "x"); }),
              ::testing::StartsWith("archive \"" + folder + "/none\" cannot be read: "));
}

TEST(DataPackage, FirstRootWithTheFileIsTaken) {
  const Scratch scratch;
  const auto second = scratch.write("b/usr/share/doc/p/f", "x");
  const std::vector<std::filesystem::path> roots = {scratch.folder() / "a", scratch.folder() / "b"};
  EXPECT_EQ(find_package_file(roots, "p", "usr/share/doc/p/f"), second);
  const auto first = scratch.write("a/usr/share/doc/p/f", "x");
  EXPECT_EQ(find_package_file(roots, "p", "usr/share/doc/p/f"), first);
}

TEST(DataPackage, RootsFollowTheEnvironment) {
  const Environment cache("XDG_CACHE_HOME", "/some/cache");
  {
    const Environment own("CONTACTCHECK_DATA", "");
    EXPECT_THAT(data_roots(), ::testing::ElementsAre("/", "/some/cache/contactcheck"));
  }
  {
    const Environment empty("XDG_CACHE_HOME", ""), own("CONTACTCHECK_DATA", "");
    const Environment home("HOME", "/home/me");
    EXPECT_THAT(data_roots(), ::testing::ElementsAre("/", "/home/me/.cache/contactcheck"));
  }
  const Environment own("CONTACTCHECK_DATA", "/data");
  EXPECT_THAT(data_roots(), ::testing::ElementsAre("/data"));
}

TEST(Datasets, MissingPackageIsOneSentenceThatNamesIt) {
  const Scratch scratch;
  const std::string place = (scratch.folder() / kArchive).string();
  EXPECT_EQ(sentence_of([&] { load_dataset("bunny00", {scratch.folder()}); }),
            "the Debian package libcgal-demo is missing (no file \"" + place +
                "\"): install it with \"apt-get install libcgal-demo\", or run .ci/setup, which "
                "also unpacks it where /usr/share/doc is left out.");
}

TEST(Teapot, MissingPackageIsOneSentenceThatNamesIt) {
  const Scratch scratch;
  EXPECT_THAT(sentence_of([&] { make_teapot(10, {scratch.folder()}); }),
              ::testing::StartsWith("the Debian package povray-examples is missing (no file "));
}

TEST(Datasets, ComeFromAnUnpackedCopyToo) {
  const Scratch scratch;
  const Scratch tar;
  const auto packed = write_tar_gz(tar, "a", small_tar());
  std::filesystem::create_directories((scratch.folder() / kArchive).parent_path());
  std::filesystem::copy_file(packed, scratch.folder() / kArchive);
  EXPECT_EQ(load_dataset("tri", {"/nowhere", scratch.folder()}).mesh.triangles.size(), 1u);
  EXPECT_EQ(
      sentence_of([&] { load_dataset("../tri", {scratch.folder()}); }),
      "libcgal-demo holds no mesh \"../tri\"; among its meshes are armadillo, bunny00, camel, "
      "cow, dino, diplodocus, elephant, triceratops.");
}

TEST(Datasets, KnownOnesAreSolids) {
  if (!installed(kArchive)) GTEST_SKIP() << "install libcgal-demo";
  for (const std::string& name : known_datasets()) {
    EXPECT_TRUE(analyse_topology(load_dataset(name).mesh).solid) << name;
  }
  const TriangleMesh bunny = load_dataset("bunny00").mesh;
  EXPECT_EQ(bunny.vertices.size(), 37706u);
  EXPECT_EQ(bunny.triangles.size(), 75408u);
}

TEST(Teapot, HasThePapersCountsAndDefects) {
  if (!installed(kTeapot)) GTEST_SKIP() << "install povray-examples";
  const TriangleMesh teapot = make_teapot(10);
  EXPECT_EQ(teapot.vertices.size(), 3241u);
  EXPECT_EQ(teapot.triangles.size(), 6400u);
  const MeshTopology topology = analyse_topology(teapot);
  EXPECT_EQ(topology.count(MeshDefectKind::kRepeatedIndex) +
                topology.count(MeshDefectKind::kZeroAreaTriangle),
            80u);
  EXPECT_EQ(topology.count(MeshDefectKind::kBoundaryEdge), 160u);
  EXPECT_EQ(topology.count(MeshDefectKind::kInconsistentOrientation), 0u);
  EXPECT_FALSE(topology.solid);
}

TEST(Teapot, FileWithAnotherNumberOfPatchesIsRefused) {
  const Scratch scratch;
  const auto file = scratch.write(kTeapot, "bicubic_patch { <1,2,3> }");
  EXPECT_EQ(sentence_of([&] { make_teapot(10, {scratch.folder()}); }),
            "teapot file \"" + file.string() + "\" has a bicubic patch without 16 points.");
  scratch.write(kTeapot, "union { }");
  EXPECT_EQ(sentence_of([&] { make_teapot(10, {scratch.folder()}); }),
            "teapot file \"" + file.string() + "\" has 0 bicubic patches; the teapot has 32.");
}

struct Simplified {
  std::string name;
  std::size_t triangles, vertices;
};
void PrintTo(const Simplified& p, std::ostream* out) { *out << p.name; }

class SimplifiedDataset : public ::testing::TestWithParam<Simplified> {};

TEST_P(SimplifiedDataset, HasThePapersCountsAndStaysSolid) {
  if (!installed(kArchive)) GTEST_SKIP() << "install libcgal-demo";
  const TriangleMesh mesh = simplify(load_dataset(GetParam().name).mesh, GetParam().triangles);
  EXPECT_EQ(mesh.triangles.size(), GetParam().triangles);
  EXPECT_EQ(mesh.vertices.size(), GetParam().vertices);
  EXPECT_TRUE(analyse_topology(mesh).solid);
}

// The dinosaurs and the rabbit of the paper; diplodocus and armadillo need the detour.
INSTANTIATE_TEST_SUITE_P(Paper, SimplifiedDataset,
                         ::testing::Values(Simplified{"bunny00", 5914, 2959},
                                           Simplified{"dino", 1496, 750},
                                           Simplified{"diplodocus", 1496, 750},
                                           Simplified{"triceratops", 1496, 750},
                                           Simplified{"armadillo", 6000, 3002}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace contactcheck::mesh
