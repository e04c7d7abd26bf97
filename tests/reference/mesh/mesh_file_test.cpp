#include "reference/mesh/mesh_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <bit>
#include <limits>

#include "core/types/mesh_topology.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::mesh {
namespace {

using test::Scratch;
using test::sentence_of;
using ::testing::HasSubstr;

// A float cannot hold this; 17 digits name the double.
constexpr double kFine = 0.12345678901234567;
const std::string kFineText = "0.12345678901234567";

const std::string kOff = "OFF # a tetrahedron\n4 4 0\n" + kFineText +
                         " 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string kObj = "# a tetrahedron\no tetra\nv " + kFineText +
                         " 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nl 1 2\nf 1 3 2\nf 1/1/1 2/2/2 4/3/3\n"
                         "f 2 3 4\nf -4 -1 -2\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
    "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n" +
    kFineText + " 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
         "\nendloop\nendfacet\n";
}
const std::string kP = kFineText + " 0 0", kX = "1 0 0", kY = "0 1 0", kZ = "0 0 1";
const std::string kStl = "solid t\n" + facet(kP, kY, kX) + facet(kP, kX, kZ) + facet(kX, kY, kZ) +
                         facet(kP, kZ, kY) + "endsolid t\n";

void append(std::string& bytes, std::uint32_t value, bool big = false) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * (big ? 3 - i : i)) & 0xff);
}

std::string binary_stl(float first) {
  const float p[4][3] = {{first, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int facets[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  std::string bytes(80, ' ');
  append(bytes, 4);
  for (const auto& f : facets) {
    bytes += std::string(12, '\0');
    for (const int v : f) {
      for (const float x : p[v]) append(bytes, std::bit_cast<std::uint32_t>(x));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

// One triangle of floats. `second`: x of the second vertex; `last`: z of the third.
std::string binary_ply(bool big = false, float second = 1.f, float last = 0.f) {
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement vertex 3\nproperty float x\n"
                      "property float y\nproperty float z\nelement face 1\n"
                      "property list uchar int vertex_indices\nend_header\n";
  for (const float x : {0.f, 0.f, 0.f, second, 0.f, 0.f, 0.f, 1.f, last})
    append(bytes, std::bit_cast<std::uint32_t>(x), big);
  bytes += '\3';
  for (const std::uint32_t corner : {0u, 1u, 2u}) append(bytes, corner, big);
  return bytes;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

struct Format {
  std::string name, bytes;
};
void PrintTo(const Format& p, std::ostream* out) { *out << p.name; }

class MeshFormat : public ::testing::TestWithParam<Format> {};

TEST_P(MeshFormat, KeepsDoublesAndGivesASolid) {
  const Scratch scratch;
  const LoadedMesh loaded = read_mesh_file(scratch.write(GetParam().name, GetParam().bytes));
  ASSERT_EQ(loaded.mesh.vertices.size(), 4u);
  EXPECT_EQ(loaded.mesh.triangles.size(), 4u);
  EXPECT_EQ(loaded.mesh.vertices[0].x(), kFine);
  EXPECT_TRUE(analyse_topology(loaded.mesh).solid);
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFormat,
                         ::testing::Values(Format{"t.off", kOff}, Format{"t.obj", kObj},
                                           Format{"t.ply", kPly}, Format{"T.STL", kStl}),
                         [](const auto& test) { return test.param.name.substr(2); });

TEST(MeshFile, IndicesStayInTheOrderOfTheFile) {
  const Scratch scratch;
  const TriangleMesh mesh = read_mesh_file(scratch.write("t.off", kOff)).mesh;
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 2, 1}));
  EXPECT_EQ(mesh.triangles[3], (Triangle{0, 3, 2}));
  const TriangleMesh obj = read_mesh_file(scratch.write("t.obj", kObj)).mesh;
  EXPECT_EQ(obj.triangles, mesh.triangles);
}

TEST(MeshFile, BinaryStlIsWelded) {
  const Scratch scratch;
  const LoadedMesh loaded = read_mesh_file(scratch.write("t.stl", binary_stl(0.25f)));
  EXPECT_EQ(loaded.mesh.vertices.size(), 4u);
  EXPECT_TRUE(analyse_topology(loaded.mesh).solid);
  EXPECT_EQ(loaded.notes, "STL: corners at equal places joined");
}

TEST(MeshFile, PolygonsBecomeFansAndAreNoted) {
  const Scratch scratch;
  const LoadedMesh loaded = read_mesh_file(
      scratch.write("p.off", "OFF\n5 1 0\n0 0 0\n2 0 0\n3 1 0\n1 2 0\n-1 1 0\n5 0 1 2 3 4\n"));
  EXPECT_THAT(loaded.mesh.triangles,
              ::testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
  EXPECT_EQ(loaded.notes, "1 polygon split into triangles");
}

TEST(MeshFile, ConcavePolygonsAreFilledAndNoted) {
  const Scratch scratch;
  const LoadedMesh loaded = read_mesh_file(scratch.write(
      "l.obj", "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n"));
  EXPECT_EQ(loaded.notes, "1 polygon split into triangles, 1 of them concave");
  double area = 0.0;
  for (const Triangle& t : loaded.mesh.triangles) {
    const std::vector<Vec3>& v = loaded.mesh.vertices;
    const double part = 0.5 * (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).z();
    EXPECT_GT(part, 0.0);
    area += part;
  }
  EXPECT_EQ(area, 3.0);
}

TEST(MeshFile, OffIsReadWithoutItsColoursWhereverTheyEnd) {
  const Scratch scratch;
  for (const char* const colour : {"", " 7", " 0.5 0.5", " 255 0 0", " 1 0 0 1"}) {
    const std::string text = std::string("COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0") + colour +
                             "\n0 1 0\n3 0 1 2" + colour + "\n";
    const TriangleMesh mesh = read_mesh_file(scratch.write("c.off", text)).mesh;
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << colour;
    EXPECT_EQ(mesh.triangles, std::vector<Triangle>{Triangle({0, 1, 2})}) << colour;
  }
}

TEST(MeshFile, PlyIsReadWithoutItsOtherPropertiesWhateverTheirTypes) {
  const std::string coloured = with(
      with(with(kPly, "property double z\n",
                "property double z\nproperty uchar red\nproperty float g\nproperty uchar blue\n"),
           "element face", "element edge 1\nproperty list uchar int x\nelement face"),
      "\n3 0 2 1", "\n2 7 9\n3 0 2 1");
  std::string text = coloured;
  for (const std::string& vertex : {kP, kX, kY, kZ})
    text = with(text, '\n' + vertex, '\n' + vertex + " 255 0.5 128");
  const Scratch scratch;
  const TriangleMesh plain = read_mesh_file(scratch.write("plain.ply", kPly)).mesh;
  const TriangleMesh mesh = read_mesh_file(scratch.write("coloured.ply", text)).mesh;
  EXPECT_EQ(mesh.vertices, plain.vertices);
  EXPECT_EQ(mesh.triangles, plain.triangles);
}

TEST(MeshFile, PlyMayHaveEitherOrderOfBytes) {
  const Scratch scratch;
  const TriangleMesh little = read_mesh_file(scratch.write("little.ply", binary_ply())).mesh;
  const TriangleMesh big = read_mesh_file(scratch.write("big.ply", binary_ply(true))).mesh;
  EXPECT_EQ(big.vertices, little.vertices);
  EXPECT_EQ(big.triangles, little.triangles);
}

TEST(MeshFile, PlyMayCallItsElementsVerticesAndFaces) {
  const Scratch scratch;
  for (const std::string& bytes : {kPly, binary_ply()}) {
    const TriangleMesh usual = read_mesh_file(scratch.write("usual.ply", bytes)).mesh;
    const std::string plural =
        with(with(bytes, "element vertex", "element vertices"), "element face", "element faces");
    const TriangleMesh mesh = read_mesh_file(scratch.write("plural.ply", plural)).mesh;
    EXPECT_EQ(mesh.vertices, usual.vertices);
    EXPECT_EQ(mesh.triangles, usual.triangles);
  }
}

TEST(MeshFile, FloatsOfAPlyInTextAreThoseFloats) {
  const Scratch scratch;
  const std::string text = with(kPly, "double x", "float x");
  EXPECT_EQ(read_mesh_file(scratch.write("t.ply", text)).mesh.vertices[0].x(),
            static_cast<double>(static_cast<float>(kFine)));
}

const std::string kGltf = R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "translation": [1, 2, 3]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 72}],
    "buffers": [{"uri": "square.bin", "byteLength": 72}]})";

TEST(MeshFile, GltfComesThroughAssimpAsFloatsWithSplitVerticesJoined) {
  const Scratch scratch;
  // Two triangles of a square, six vertices, as exporters split them; a node moves it by (1, 2, 3).
  std::string buffer;
  for (const float x : {0.1f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f,  //
                        0.1f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) {
    append(buffer, std::bit_cast<std::uint32_t>(x));
  }
  scratch.write("square.bin", buffer);
  const LoadedMesh loaded = read_mesh_file(scratch.write("square.gltf", kGltf));
  EXPECT_EQ(loaded.mesh.vertices.size(), 4u);
  EXPECT_EQ(loaded.mesh.triangles.size(), 2u);
  EXPECT_EQ(loaded.mesh.vertices[0].x(), static_cast<double>(0.1f + 1.0f));
  EXPECT_EQ(loaded.mesh.vertices[0].z(), 3.0);
  EXPECT_EQ(loaded.notes, "read as float by assimp; 2 vertices at equal places joined");
}

TEST(MeshFile, WhiteSpaceAndCommentsMayFollow) {
  const Scratch scratch;
  for (const std::string end : {"", "\n", " \t\r\n\n", "\n# the end 1 2 3\n"}) {
    EXPECT_EQ(read_mesh_file(scratch.write("t.off", kOff + end)).mesh.triangles.size(), 4u);
    if (end.find('#') != std::string::npos) continue;
    EXPECT_EQ(read_mesh_file(scratch.write("t.ply", kPly + end)).mesh.triangles.size(), 4u);
    EXPECT_EQ(read_mesh_file(scratch.write("b.ply", binary_ply() + end)).mesh.vertices[1],
              Vec3(1, 0, 0));
  }
}

struct BadMesh {
  std::string name, file, bytes, sentence;  // the sentence after: mesh file "PATH"
};
void PrintTo(const BadMesh& p, std::ostream* out) { *out << p.name; }

class BadMeshFile : public ::testing::TestWithParam<BadMesh> {};

TEST_P(BadMeshFile, IsRefusedWithOneSentence) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.write(GetParam().file, GetParam().bytes);
  EXPECT_EQ(sentence_of([&] { read_mesh_file(file); }),
            "mesh file \"" + file.string() + "\"" + GetParam().sentence);
}

INSTANTIATE_TEST_SUITE_P(
    Defects, BadMeshFile,
    ::testing::Values(
        BadMesh{"Empty", "a.obj", "", " is empty."},
        BadMesh{"OffNan", "a.off", with(kOff, "\n1 0 0", "\n1 nan 0"),
                ": vertex 1 (line 4) has the coordinate \"nan\"; coordinates must be finite "
                "numbers."},
        BadMesh{"OffInfinity", "a.off", with(kOff, "0 0 1\n", "0 0 -inf\n"),
                ": vertex 3 (line 6) has the coordinate \"-inf\"; coordinates must be finite "
                "numbers."},
        BadMesh{"ObjOverflow", "a.obj", with(kObj, "v 0 1 0", "v 0 1e999 0"),
                ": vertex 2 (line 5) has the coordinate \"1e999\"; coordinates must be finite "
                "numbers."},
        BadMesh{"ObjWord", "a.obj", with(kObj, "v 0 1 0", "v 0 one 0"),
                ": vertex 2 (line 5) has the coordinate \"one\"; coordinates must be finite "
                "numbers."},
        BadMesh{"ObjShortVertex", "a.obj", with(kObj, "v 0 1 0", "v 0 1"),
                ": vertex 2 (line 5) has fewer than three coordinates."},
        BadMesh{"PlyNan", "a.ply", with(kPly, "\n0 1 0", "\n0 nan 0"),
                ": vertex 2 (line 12) has the coordinate \"nan\"; coordinates must be finite "
                "numbers."},
        BadMesh{"PlyNanOfVertices", "a.ply",
                with(with(kPly, "element vertex", "element vertices"), "\n0 1 0", "\n0 nan 0"),
                ": vertex 2 (line 12) has the coordinate \"nan\"; coordinates must be finite "
                "numbers."},
        BadMesh{"BinaryPlyNan", "a.ply",
                binary_ply(false, 1.f, std::numeric_limits<float>::quiet_NaN()),
                ": vertex 2 has the coordinate \"nan\"; coordinates must be finite numbers."},
        BadMesh{"BinaryPlyInfinity", "a.ply",
                binary_ply(true, -std::numeric_limits<float>::infinity()),
                ": vertex 1 has the coordinate \"inf\"; coordinates must be finite numbers."},
        BadMesh{"StlNan", "a.stl", with(kStl, "vertex 0 1 0", "vertex 0 nan 0"),
                ": vertex 1 (line 5) has the coordinate \"nan\"; coordinates must be finite "
                "numbers."},
        BadMesh{"BinaryStlNan", "a.stl", binary_stl(std::numeric_limits<float>::quiet_NaN()),
                ": corner 0 of triangle 0 has the coordinate \"nan\"; coordinates must be finite "
                "numbers."},
        BadMesh{"OffIndex", "a.off", with(kOff, "3 0 3 2", "3 0 3 9"),
                ": face 3 (line 10) names the vertex 9; the file has 4, counted from 0."},
        BadMesh{"OffMoreFaces", "a.off", with(kOff, "4 4 0", "4 2 0") + " \n# the end\n",
                " has 2 lines more than its header's 4 vertices and 2 faces: \"3 1 2 3\"."},
        BadMesh{"OffOneLineMore", "a.off", kOff + "7",
                " has 1 line more than its header's 4 vertices and 4 faces: \"7\"."},
        BadMesh{"StlMoreBytes", "a.stl", binary_stl(0.25f) + std::string(50, '\0'),
                " has 50 bytes more than its 4 triangles."},
        BadMesh{"StlMoreBytesThoughSolid", "a.stl", "solid" + binary_stl(0.25f).substr(5) + "x",
                " has 1 byte more than its 4 triangles."},
        BadMesh{"PlyWithoutZ", "a.ply", with(kPly, "property double z\n", ""),
                " has vertices without a property z."},
        BadMesh{"PlyWithoutXOfItsName", "a.ply", with(kPly, "double x", "double X"),
                " has vertices without a property x."},
        BadMesh{"PlyVerticesTwice", "a.ply",
                with(kPly, "element face",
                     "element vertices 0\nproperty double x\nproperty double y\n"
                     "property double z\nelement face"),
                " has more than one element of vertices."},
        BadMesh{"PlyFacesTwice", "a.ply",
                with(kPly, "end_header",
                     "element face 1\nproperty list uchar int vertex_indices\nend_header") +
                    "3 0 1 2\n",
                " has more than one element of faces."},
        BadMesh{"PlyMoreNumbersOnALine", "a.ply", with(kPly, "\n1 0 0", "\n1 0 0 5 5"),
                ": vertex 1 (line 11) has more on its line than its properties: \"5 5\"."},
        BadMesh{"PlyMoreNumbersOfAStrangeElement", "a.ply",
                with(with(kPly, "element vertex", "element ver\x01tex"), "\n1 0 0", "\n1 0 0 5 5"),
                ": \"ver?tex\" 1 (line 11) has more on its line than its properties: \"5 5\"."},
        BadMesh{"PlyMoreFaces", "a.ply", kPly + "3 0 1 2\n",
                " goes on after the last element of its header (line 18): \"3 0 1 2\"."},
        BadMesh{"PlyIndex", "a.ply", with(kPly, "3 0 3 2", "3 0 3 9"),
                ": face 3 (line 17) names the vertex 9; the file has 4, counted from 0."},
        BadMesh{"PlyIndexNegative", "a.ply", with(kPly, "3 0 3 2", "3 0 3 -1"),
                ": face 3 (line 17) names the vertex -1; the file has 4, counted from 0."},
        BadMesh{"PlyMoreBytes", "a.ply", binary_ply() + "wxyz",
                " has 4 bytes more than its header says."},
        BadMesh{"ObjIndex", "a.obj", with(kObj, "f 2 3 4", "f 2 3 5"),
                ": face 2 (line 10) names the vertex 5; the file has 4."},
        BadMesh{"ObjIndexFarOut", "a.obj", with(kObj, "f 2 3 4", "f 2 3 4294967298"),
                ": face 2 (line 10) names the vertex 4294967298; the file has 4."},
        BadMesh{"ObjIndexNegative", "a.obj", with(kObj, "f 2 3 4", "f 2 3 -9"),
                ": face 2 (line 10) names the vertex -9; the file has 4 before that line."},
        BadMesh{"ObjIndexBeforeItsVertex", "a.obj", "v 0 0 0\nf -1 -2 -3\nv 1 0 0\nv 0 1 0\n",
                ": face 0 (line 2) names the vertex -2; the file has 1 before that line."},
        BadMesh{"ObjIndexZero", "a.obj", with(kObj, "f 2 3 4", "f 2 3 0"),
                ": face 2 (line 10) names the vertex 0; they count from 1."},
        BadMesh{"ObjIndexFraction", "a.obj", with(kObj, "f 1 3 2", "f 1.9 3.2 2.999"),
                ": face 0 (line 8) has the vertex index \"1.9\", which is no whole number."},
        BadMesh{"ObjIndexExponent", "a.obj", with(kObj, "f 1 3 2", "f 1e0 3 2"),
                ": face 0 (line 8) has the vertex index \"1e0\", which is no whole number."},
        BadMesh{"ObjIndexTail", "a.obj", with(kObj, "f 1/1/1 2/2/2", "f 1/1/1 2x/2/2"),
                ": face 1 (line 9) has the vertex index \"2x/2/2\", which is no whole number."},
        BadMesh{"ObjFaceCutShort", "a.obj", with(kObj, "f 2 3 4", "f 2 3 x"),
                ": face 2 (line 10) has the vertex index \"x\", which is no whole number."},
        BadMesh{"OffTruncated", "a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n",
                " ends within vertex 2 of 4."},
        BadMesh{"OffLyingHeader", "a.off", "OFF\n4000000000 4 0\n0 0 0\n",
                " claims 4000000000 vertices and 4 faces, more than its 25 bytes can hold."},
        BadMesh{"OffPolygonLongerThanItsLine", "a.off", with(kOff, "3 0 3 2", "4000000000 0 3 2"),
                " ends within face 3 of 4."},
        BadMesh{"OffIndexNotWhole", "a.off", with(kOff, "3 0 3 2", "3 0 3 1e300"),
                ": face 3 (line 10) has the vertex index \"1e300\", which is no whole number."},
        BadMesh{"OffCornersNotWhole", "a.off", with(kOff, "3 0 3 2", "3.0 0 3 2"),
                ": face 3 (line 10) begins with \"3.0\", which is no number of corners."},
        BadMesh{"OffOfAWord", "a.off", "COFFEE\n4 4 0\n",
                " has \"EE\" on line 1, where the number of vertices should be."},
        BadMesh{"OffPrefixTwice", "a.off", "CC" + kOff, " is no OFF: it begins with \"CCOFF\"."},
        BadMesh{"OffWordBehindAVertex", "a.off", with(kOff, "\n1 0 0", "\n1 0 0 f"),
                ": vertex 1 (line 4) has \"f\" behind its coordinates."},
        BadMesh{"OffBinaryCutShort", "a.off",
                "OFF BINARY\n" + std::string("\0\0\0\3\0\0\0\1\0\0\0\0\1", 13),
                " ends within vertex 0 of 3."},
        BadMesh{"OffBinaryOfLies", "a.off",
                "OFF BINARY\n" + std::string("\x7f\0\0\3\0\0\0\1\0\0\0\0", 12),
                " claims 2130706435 vertices and 1 faces, more than its 23 bytes can hold."},
        BadMesh{"ObjKeywordThatIsANumber", "a.obj", with(kObj, "f 2 3 4", "f 2 3\n4"),
                ": line 11 begins with \"4\", which is no keyword."},
        BadMesh{"ObjTwoLinesInOne", "a.obj", with(kObj, "v 0 1 0\n", "v 0 1 0 "),
                ": vertex 2 (line 5) has \"v\" behind its coordinates."},
        BadMesh{"ObjDecimalComma", "a.obj", with(kObj, "v 0 1 0", "v 0 1,5 0"),
                ": vertex 2 (line 5) has the coordinate \"1,5\"; coordinates must be finite "
                "numbers."},
        BadMesh{"ObjNanOfARuntime", "a.obj", with(kObj, "v 0 1 0", "v 0 1.#QNAN 0"),
                ": vertex 2 (line 5) has the coordinate \"1.#QNAN\"; coordinates must be finite "
                "numbers."},
        BadMesh{"ObjHexadecimal", "a.obj", with(kObj, "v 0 1 0", "v 0 0x1 0"),
                ": vertex 2 (line 5) has the coordinate \"0x1\"; coordinates must be finite "
                "numbers."},
        BadMesh{"ObjWithoutFaces", "a.obj", "v 0 0 0\nl 1 1\n", " holds no face."},
        BadMesh{"ObjInUtf16", "a.obj", std::string("\xff\xfev\0 \0", 6),
                " is a text in UTF-16; it must be in UTF-8."},
        BadMesh{"StlVertexInNoFacet", "a.stl", with(kStl, "facet normal 0 0 0\n", ""),
                ": vertex 0 (line 3) is in no facet."},
        BadMesh{"StlFacetOfTwoVertices", "a.stl", with(kStl, "vertex 1 0 0\n", ""),
                ": triangle 0 ends on line 7 with 2 vertices."},
        BadMesh{"StlFacetWithoutAnEnd", "a.stl", with(kStl, "endfacet\n", ""),
                ": triangle 0 does not end before line 8."},
        BadMesh{"StlCutShort", "a.stl", kStl.substr(0, kStl.size() - 30),
                " ends within triangle 3."},
        BadMesh{"StlStrangeWord", "a.stl", with(kStl, "endloop", "end loop"),
                ": line 7 has \"end\", which is no word of STL."},
        BadMesh{
            "StlBinaryCutShort", "a.stl", binary_stl(0.25f).substr(0, 200),
            " is no STL in text, and too short for a binary one: its header claims 4 triangles, "
            "and it ends within triangle 2."},
        BadMesh{
            "StlOfNothing", "a.stl", "hello",
            " is no STL: it begins neither with \"solid\" nor as a binary file does, whose header "
            "has 84 bytes."},
        BadMesh{"PlyListLongerThanTheFile", "a.ply",
                with(with(kPly, "list uchar", "list uint"), "3 0 3 2", "4000000000 0 3 2"),
                " ends within face 3 of 4."},
        BadMesh{"PlyCutShort", "a.ply", kPly.substr(0, kPly.size() - 12),
                " ends within face 2 of 4."},
        BadMesh{"PlyBinaryCutShort", "a.ply", binary_ply().substr(0, binary_ply().size() - 14),
                " ends within vertex 2 of 3."},
        BadMesh{"PlyUnknownFormat", "a.ply", with(kPly, "ascii", "binary"),
                ": line 2 of its header has the format \"binary\"; it is ascii, "
                "binary_little_endian or binary_big_endian."},
        BadMesh{"PlyFormatTwice", "a.ply",
                with(kPly, "element face", "format binary_little_endian 1.0\nelement face"),
                ": line 7 of its header is a second format."},
        BadMesh{"PlyWithoutAFormat", "a.ply", with(kPly, "format ascii 1.0\n", ""),
                " has a header without a format."},
        BadMesh{"PlyUnknownType", "a.ply", with(kPly, "double y", "half y"),
                ": line 5 of its header has the type \"half\", which PLY does not know."},
        BadMesh{"PlyLengthOutOfRange", "a.ply", with(kPly, "3 0 3 2", "259 0 3 2"),
                ": face 3 (line 17) has \"259\" as the length of a list, which is no uchar."},
        BadMesh{"PlyIndexNotWhole", "a.ply", with(kPly, "3 0 3 2", "3 0 3 2.5"),
                ": face 3 (line 17) has \"2.5\" as a vertex index, which is no int."},
        BadMesh{"PlyIndexBeyondItsType", "a.ply",
                with(with(kPly, "uchar int", "uchar char"), "3 0 3 2", "3 0 3 128"),
                ": face 3 (line 17) has \"128\" as a vertex index, which is no char."},
        BadMesh{
            "PlyFractionOfAWholeCoordinate", "a.ply", with(kPly, "double x", "int x"),
            ": vertex 0 (line 10) has \"0.12345678901234567\" as a coordinate, which is no int."},
        BadMesh{"PlyWordInPlaceOfANumber", "a.ply",
                with(with(kPly, "double z", "double z\nproperty uchar q"), " 0 0\n1 0 0",
                     " 0 0 255.0\n1 0 0 red"),
                ": vertex 1 (line 12) has \"red\" in place of a number."},
        BadMesh{"PlyListOfCoordinates", "a.ply", with(kPly, "double x", "list uchar double x"),
                ": line 4 of its header is a list of coordinates; each is one number."},
        BadMesh{"PlyIndicesOfFloats", "a.ply", with(kPly, "list uchar int", "list uchar float"),
                ": line 8 of its header has vertex indices that are no list of whole numbers."},
        BadMesh{"PlyFacesWithoutIndices", "a.ply", with(kPly, "vertex_indices", "indices"),
                " has an element \"face\" without a list of vertex indices."},
        BadMesh{"PlyOfLies", "a.ply", with(kPly, "vertex 4", "vertex 4000000000"),
                " claims 4000000000 elements \"vertex\", more than its 240 bytes can hold."},
        BadMesh{"PlyEndsWithItsHeader", "a.ply", kPly.substr(0, kPly.find("end_header") + 10),
                " ends within vertex 0 of 4."},
        BadMesh{"PlyWithoutTheEndOfItsHeader", "a.ply", kPly.substr(0, kPly.find("end_header")),
                " has a header without an end."},
        BadMesh{"PlyHeaderOfNothing", "a.ply", "ply\nformat ascii 1.0\nend_header",
                " holds no triangle."},
        BadMesh{"PlyHeaderOfNothingBinary", "a.ply",
                "ply\nformat binary_little_endian 1.0\nend_header\v" + std::string(2, '\0'),
                " has no end of line behind \"end_header\"."},
        BadMesh{
            "PolygonsThatCrossThemselvesAlone", "a.off",
            "OFF\n5 1 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n-1 0.5 0\n5 0 1 2 3 4\n",
            " holds no triangle: face 0 (line 8), of 5 corners, crosses or folds back on itself: "
            "left out (--repair, in a scene \"repair\": true, fills it by a fan)."},
        BadMesh{"NoTriangle", "a.off", "OFF\n2 1 0\n0 0 0\n1 0 0\n2 0 1\n", " holds no triangle."},
        BadMesh{"NotAMesh", "a.ply", "hello\n", " is no PLY: it does not begin with \"ply\"."}),
    [](const auto& test) { return test.param.name; });

// Flat to rounding, or warped: a file is not refused for that, and the note says so.
TEST(MeshFile, QuadsThatCrossThemselvesAreFans) {
  const LoadedMesh loaded = read_mesh_bytes(
      SoupFormat::kOff, "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1e-7 0\n0 -1e-7 0\n4 0 1 2 3\n", "a.off");
  EXPECT_EQ(loaded.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(loaded.notes, "1 polygon split into triangles, 1 of four corners cross themselves");
}

TEST(MeshFile, UnknownFormatsNameThoseThatAreRead) {
  const Scratch scratch;
  for (const char* const name :
       {"a.abc", "a.usd", "a.vtk", "a.vtu", "a.pvd", "a.msh", "a.npz", "a.bgeo", "a.txt"})
    EXPECT_THAT(
        sentence_of([&] { read_mesh_file(scratch.write(name, "hello")); }),
        HasSubstr("\" is no format that is read; formats that are read: .obj, .off, .ply and "
                  ".stl in doubles; "))
        << name;
  EXPECT_THAT(sentence_of([&] { read_mesh_file(scratch.write("mesh", "hello")); }),
              HasSubstr("mesh\" cannot be read: it has no extension; formats that are read: "));
  // MEDIT's, where assimp knows Ogre's of that extension.
  EXPECT_THAT(sentence_of([&] {
                read_mesh_file(scratch.write("a.mesh", "MeshVersionFormatted 1\nDimension 3\n"));
              }),
              HasSubstr("; formats that are read: .obj, "));
}

TEST(MeshFile, AnimationsAreLeftOutWithANote) {
  const Scratch scratch;
  std::string buffer;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 0.f, 0.f, 1.f,
                        1.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 5.f, 0.f, 0.f})
    append(buffer, std::bit_cast<std::uint32_t>(x));
  scratch.write("square.bin", buffer);
  const std::string moving = with(
      with(with(kGltf, "\"nodes\": [{", R"("animations": [{"channels": [{"sampler": 0, "target":
               {"node": 0, "path": "translation"}}], "samplers": [{"input": 1, "output": 2}]}],
               "nodes": [{)"),
           "\"max\": [1, 1, 0]}]", R"("max": [1, 1, 0]},
               {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR",
                "min": [0], "max": [1]},
               {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}])"),
      "\"byteLength\": 72}],",
      R"("byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 8},
               {"buffer": 0, "byteOffset": 80, "byteLength": 24}],)");
  const LoadedMesh loaded =
      read_mesh_file(scratch.write("a.gltf", with(moving, "square.bin\", \"byteLength\": 72",
                                                  "square.bin\", \"byteLength\": 104")));
  EXPECT_THAT(loaded.notes, HasSubstr("; 1 animation left out: the mesh is at rest"));
}

TEST(MeshFile, MissingFileAndFolderAreNamed) {
  const Scratch scratch;
  const std::string missing = (scratch.folder() / "no.obj").string();
  EXPECT_EQ(sentence_of([&] { read_mesh_file(missing); }),
            "mesh file \"" + missing + "\" does not exist.");
  EXPECT_EQ(sentence_of([&] { read_mesh_file(scratch.folder()); }),
            "mesh file \"" + scratch.folder().string() + "\" is a folder, not a regular file.");
}

// glTF keeps the bytes of its vertices in a file apart, which nobody may be writing to either.
TEST(MeshFile, PipeThatAFileNamesIsNotWaitedFor) {
  const Scratch scratch;
  const std::filesystem::path pipe = scratch.folder() / "square.bin";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::filesystem::path file = scratch.write("square.gltf", kGltf);
  EXPECT_EQ(
      sentence_of([&] { read_mesh_file(file); }),
      "mesh file \"" + file.string() + "\" cannot be read by assimp: \"" + pipe.string() +
          "\" is a pipe, not a regular file; formats that are read: .obj, .off, .ply and .stl "
          "in doubles; .3ds, .dae, .fbx, .glb, .gltf, .x3d and others by assimp, in floats.");
}

}  // namespace
}  // namespace contactcheck::mesh
