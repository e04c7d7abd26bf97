// One tetrahedron, written as people and programs write it: the same bits and triangles each time.
#include <gmock/gmock.h>

#include <bit>
#include <cctype>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "reference/mesh/mesh_file.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::mesh::variants {
namespace {

using test::sentence_of;

// Of floats, so that formats of floats give the same bits.
const std::vector<Vec3> kVertices = {{0.25, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1.5}};
const std::vector<Triangle> kTriangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

const std::string kPoints = "0.25 0 0\n1 0 0\n0 1 0\n0 0 -1.5\n";
const std::string kOffFaces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string kOff = "OFF\n4 4 6\n" + kPoints + kOffFaces;
const std::string kObj =
    "v 0.25 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const std::string kPlyHead =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n";
const std::string kPlyFaces =
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPly = kPlyHead + kPlyFaces + kPoints + kOffFaces;
const std::string kStl =
    "solid t\n"
    "facet normal 0 0 1\nouter loop\nvertex 0.25 0 0\nvertex 0 1 0\nvertex 1 0 "
    "0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0.25 0 0\nvertex 1 0 0\nvertex 0 0 -1.5\nendloop\n"
    "endfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 "
    "-1.5\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0.25 0 0\nvertex 0 0 -1.5\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid t\n";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}
std::string everywhere(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}
std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

void append(std::string& out, std::uint64_t value, std::size_t bytes, bool big) {
  for (std::size_t i = 0; i < bytes; ++i)
    out += static_cast<char>(value >> (8 * (big ? bytes - 1 - i : i)) & 0xff);
}
void append(std::string& out, double value, bool big) {
  append(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4, big);
}

// With a list of another type of `bytes`; `end`: of the header's lines.
std::string binary_ply(const std::string& type, std::size_t bytes, bool big,
                       const std::string& end = "\n") {
  std::string out = with(kPlyHead, "ascii", big ? "binary_big_endian" : "binary_little_endian") +
                    with(kPlyFaces, "uchar int", "uchar " + type);
  out = everywhere(out, "\n", end);
  for (const Vec3& v : kVertices)
    for (const double x : v) append(out, x, big);
  for (const Triangle& t : kTriangles) {
    out += '\3';
    for (const std::uint32_t i : t) append(out, i, bytes, big);
  }
  return out;
}

std::string binary_off(const std::string& keyword, std::size_t more) {
  std::string out = keyword + " BINARY\n";
  for (const std::uint32_t count : {4u, 4u, 6u}) append(out, count, 4, true);
  for (const Vec3& v : kVertices) {
    for (const double x : v) append(out, x, true);
    for (std::size_t i = 0; i < more; ++i) append(out, 0.5, true);
  }
  for (std::size_t f = 0; f < kTriangles.size(); ++f) {
    append(out, 3, 4, true);
    for (const std::uint32_t i : kTriangles[f]) append(out, i, 4, true);
    append(out, f, 4, true);
    for (std::size_t i = 0; i < f; ++i) append(out, 0.5, true);
  }
  return out;
}

std::string binary_stl(std::string header) {
  header.resize(80, ' ');
  append(header, 4, 4, false);
  for (const Triangle& t : kTriangles) {
    header += std::string(12, '\x7f');  // a normal that is no number
    for (const std::uint32_t i : t)
      for (const double x : kVertices[i]) append(header, x, false);
    header += std::string(2, '\1');
  }
  return header;
}

struct Variant {
  std::string name;
  SoupFormat format;
  std::string bytes;
  std::string notes = {};
};
void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

const std::string kJoined = "STL: corners at equal places joined";

std::vector<Variant> variants() {
  constexpr SoupFormat obj = SoupFormat::kObj, off = SoupFormat::kOff, ply = SoupFormat::kPly,
                       stl = SoupFormat::kStl;
  const std::string mark = "\xEF\xBB\xBF";
  std::vector<Variant> out = {
      {"ObjPlain", obj, kObj},
      {"ObjTabs", obj, everywhere(kObj, " ", "\t")},
      {"ObjByteOrderMark", obj, mark + kObj},
      {"ObjLinesOfWindows", obj, everywhere(kObj, "\n", "\r\n")},
      {"ObjLinesOfOldMacs", obj, everywhere(kObj, "\n", "\r")},
      {"ObjBlanksAtEnds", obj, everywhere(kObj, "\n", " \t \n  ")},
      {"ObjNoLastLineEnd", obj, kObj.substr(0, kObj.size() - 1)},
      {"ObjFaceContinued", obj, with(kObj, "f 1 3 2", "f 1 3 \\\n 2")},
      {"ObjFaceContinuedWithinAWord", obj, with(kObj, "f 1 3 2", "f 1 3\\\r\n 2")},
      {"ObjFaceContinuedBehindBlanks", obj, with(kObj, "f 1 3 2", "f 1 3 \\ \t\n 2")},
      {"ObjBackslashAtTheEnd", obj, kObj.substr(0, kObj.size() - 1) + " \\"},
      {"ObjBackslashAndBlanksAtTheEnd", obj, kObj.substr(0, kObj.size() - 1) + "\\  "},
      {"ObjBackslashWithinAWord", obj, "usemtl C:\\wood\\oak\n" + kObj},
      {"ObjVertexContinued", obj, with(kObj, "v 0 0 -1.5", "v 0 \\\n0 \\\n-1.5")},
      {"ObjCommentThatEndsInABackslash", obj, "# C:\\models\\\n" + kObj},
      {"ObjCommentBehindAFace", obj, with(kObj, "f 1 3 2", "f 1 3 2# of it\n#")},
      {"ObjVerticesBehindFaces", obj, kObj.substr(kObj.find('f')) + kObj.substr(0, kObj.find('f'))},
      {"ObjNegative", obj, with(kObj, "f 1 4 3", "f -4 -1 -2")},
      {"ObjTexturesAndNormals", obj,
       with(with(kObj, "f 1 3 2", "f 1/1 3/2 2/3"), "f 1 2 4", "f 1//1 2//1 4//1")},
      {"ObjOldKeywordOfFaces", obj, everywhere(kObj, "f ", "fo ")},
      {"ObjColours", obj, everywhere(kObj, " 0\n", " 0 0.5 0.5 0.5\n")},
      {"ObjColoursThatAreNoNumbers", obj, with(kObj, " 0\n", " 0 nan -nan(ind) 1.#INF\n")},
      {"ObjFortran", obj, with(with(kObj, "0.25", "2.5D-01"), "-1.5", "-.15d+1")},
      {"ObjPlusSigns", obj, with(with(kObj, "0.25", "+.25e0"), "f 1 3 2", "f +1 3 2")},
      {"ObjGroupsAndMaterials", obj,
       "mtllib a.mtl\no a#1\ng\ns off\n" +
           with(kObj, "f", "usemtl red\nvn 0 0 1\nvt 0 0\nl 1 2\nf")},
      {"ObjUnknownKeywords", obj, "ms 0 0\nms 1 1\n" + kObj + "t crease 2/1/0 0 1\n$ by somebody\n",
       "2 lines \"ms\" left out (the first is line 1); 1 line \"t\" left out (line 11); 1 line "
       "\"$\" left out (line 12)"},
      {"OffPlain", off, kOff},
      {"OffByteOrderMark", off, mark + kOff},
      {"OffWithoutKeyword", off, kOff.substr(4)},
      {"OffCountsBehindTheKeyword", off, with(kOff, "OFF\n", "OFF")},
      {"OffCountsOnTheLineOfTheKeyword", off, with(kOff, "OFF\n", "OFF ")},
      {"OffWithoutEdges", off, with(kOff, "4 4 6", "4 4")},
      {"OffCountsOnLinesOfTheirOwn", off, with(kOff, "4 4 6", "4\n4\n6")},
      {"OffOneNumberALine", off, "OFF\n" + everywhere(kOff.substr(4), " ", "\n")},
      {"OffOnOneLine", off, everywhere(kOff, "\n", " ")},
      {"OffSeveralElementsALine", off,
       with(with(kOff, "0.25 0 0\n", "0.25 0 0 "), "3 0 2 1\n", "3 0 2 1 ")},
      {"OffLinesOfWindows", off, everywhere(kOff, "\n", "\r\n")},
      {"OffComments", off, "# of\n" + everywhere(kOff, "\n", " # 7\n# 8 9\n")},
      {"OffColoursOfFaces", off,
       with(with(kOff, "3 0 2 1", "3 0 2 1 255 0 0"), "3 0 1 3", "3 0 1 3 0.1 0.2 0.3 1")},
      {"OffColoursWithoutAPrefix", off, everywhere(kOff, "0 0\n", "0 0 7 8 9\n")},
      {"OffFaceOverSeveralLines", off, with(kOff, "3 0 2 1", "3 0\n2\n\n1")},
      {"OffFaceOverSeveralLinesBesideColours", off,
       with(with(kOff, "3 0 2 1", "3 0\n2\n1 255 0 0"), "3 0 1 3", "3 0 1 3 1")},
      {"OffHomogeneous", off,
       "4" + with(everywhere(kOff, " 0\n", " 0 1\n"), "-1.5\n", "-1.5 1.0\n")},
      {"BinaryOff", off, binary_off("OFF", 0)},
      {"BinaryOffNormals", off, binary_off("NOFF", 3)},
      {"BinaryOffTexturesAndColours", off, binary_off("STCOFF", 6)},
      {"PlyPlain", ply, kPly},
      {"PlyByteOrderMark", ply, mark + kPly},
      {"PlyLinesOfWindows", ply, everywhere(kPly, "\n", "\r\n")},
      {"PlyLinesOfOldMacs", ply, everywhere(kPly, "\n", "\r")},
      {"PlyCommentBeforeFormat", ply, with(kPly, "ply\n", "ply\ncomment by hand\nobj_info 7\n")},
      {"PlyBlanks", ply, everywhere(with(kPly, "element", " element"), "\n", " \n")},
      {"PlyWholeCoordinates", ply, with(kPly, "float y", "int y")},
      {"PlyDoubles", ply, with(kPly, "float x", "float64 x")},
      {"PlyNormalsThatAreNoNumbers", ply,
       everywhere(
           everywhere(with(kPly, "float z\n", "float z\nproperty float nx\nproperty float ny\n"),
                      " 0\n", " 0 nan -1.#IND\n"),
           "-1.5\n", "-1.5 inf 1e999\n")},
      {"PlyListsOfShorts", ply, with(kPly, "uchar int", "uint16 short")},
      {"PlyListsOfBytes", ply, with(kPly, "uchar int", "int8 uint8")},
      {"BinaryPly", ply, binary_ply("int", 4, false)},
      {"BinaryPlyBigEndian", ply, binary_ply("uint", 4, true)},
      {"BinaryPlyBytes", ply, binary_ply("uchar", 1, false)},
      {"BinaryPlyShorts", ply, binary_ply("ushort", 2, true)},
      {"BinaryPlyLinesOfWindows", ply, binary_ply("int", 4, false, "\r\n")},
      {"BinaryPlyLinesOfOldMacs", ply, binary_ply("int", 4, false, "\r")},
      {"StlPlain", stl, kStl, kJoined},
      {"StlTab", stl, with(kStl, "solid ", "solid\t"), kJoined},
      {"StlCapital", stl, with(kStl, "solid", "Solid"), kJoined},
      {"StlUpper", stl, upper(kStl), kJoined},
      {"StlByteOrderMark", stl, mark + kStl, kJoined},
      {"StlNameOfItsWords", stl, everywhere(kStl, "solid t", "solid my solid facet vertex 1"),
       kJoined},
      {"StlWithoutAName", stl, everywhere(kStl, "solid t", "solid"), kJoined},
      {"StlLinesOfWindows", stl, everywhere(kStl, "\n", "\r\n"), kJoined},
      {"StlIndented", stl, everywhere(kStl, "\n", "\n  "), kJoined},
      {"StlFacetOnOneLine", stl, with(everywhere(kStl, "\n", " "), "t ", "t\n"), kJoined},
      {"StlNormalsThatAreNoNumbers", stl, everywhere(kStl, "0 0 1", "-nan(ind) nan 1.#QNAN"),
       kJoined},
      {"StlTwoSolids", stl, with(kStl, "endfacet\nfacet", "endfacet\nendsolid t\nsolid u\nfacet"),
       kJoined},
      {"StlWithoutItsEnd", stl, kStl.substr(0, kStl.find("endsolid")),
       "no \"endsolid\" at its end: it may be cut short; " + kJoined},
      {"BinaryStl", stl, binary_stl("by somebody"), kJoined},
      {"BinaryStlThatSaysSolid", stl, binary_stl("solid t"), kJoined},
      {"BinaryStlWithAHeaderOfZeros", stl, binary_stl(std::string(80, '\0')), kJoined},
  };
  for (const std::string prefix : {"C", "N", "ST", "CN", "NC", "CST", "STC", "NCST"}) {
    // Three numbers of a normal, four of a colour, two of a texture.
    std::string more;
    for (const auto& [letters, values] :
         {std::pair{"C", " 255 0 0 1"}, {"N", " 0 0 1"}, {"ST", " 0.5 0.5"}})
      if (prefix.find(letters) != prefix.npos) more += values;
    out.push_back({"OffPrefix" + prefix, off,
                   prefix + "OFF\n4 4 6\n" + everywhere(kPoints, "\n", more + "\n") + kOffFaces});
  }
  return out;
}

class MeshVariant : public ::testing::TestWithParam<Variant> {};

TEST_P(MeshVariant, HasTheSameBitsAndTriangles) {
  LoadedMesh loaded;
  ASSERT_EQ(sentence_of([&] {
              loaded = read_mesh_bytes(GetParam().format, GetParam().bytes, "mesh file \"a\"");
            }),
            "");
  std::vector<Vec3> vertices = kVertices;
  std::vector<Triangle> triangles = kTriangles;
  if (GetParam().format == SoupFormat::kStl) {
    // In the order in which corners come.
    vertices = {kVertices[0], kVertices[2], kVertices[1], kVertices[3]};
    triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {0, 3, 1}};
  }
  EXPECT_EQ(loaded.mesh.vertices, vertices);
  EXPECT_EQ(loaded.mesh.triangles, triangles);
  EXPECT_EQ(loaded.notes, GetParam().notes);
}

INSTANTIATE_TEST_SUITE_P(All, MeshVariant, ::testing::ValuesIn(variants()),
                         [](const auto& test) { return test.param.name; });

TEST(TriangleStrips, AreTurnedEverySecondTimeAndBeginAnewBehindMinusOne) {
  const std::string bytes =
      kPlyHead + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
      kPoints + "11 0 2 1 3 3 0 -1 0 3 2 2\n";
  const LoadedMesh loaded = read_mesh_bytes(SoupFormat::kPly, bytes, "a.ply");
  // 0 2 1, then 2 1 3 turned; a corner twice only leads on.
  EXPECT_EQ(loaded.mesh.triangles, (std::vector<Triangle>{{0, 2, 1}, {1, 2, 3}, {0, 3, 2}}));
  EXPECT_EQ(loaded.notes, "3 triangles of strips");
}

TEST(OffHomogeneous, IsDividedByItsWeight) {
  const std::string bytes = "4OFF\n3 1 0\n1 2 3 2\n-1 0 0 -4\n0 1 0 1\n3 0 1 2\n";
  const LoadedMesh loaded = read_mesh_bytes(SoupFormat::kOff, bytes, "a.off");
  EXPECT_EQ(loaded.mesh.vertices, (std::vector<Vec3>{{0.5, 1, 1.5}, {0.25, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(sentence_of(
                [&] { read_mesh_bytes(SoupFormat::kOff, with(bytes, "3 2\n", "3 0\n"), "a.off"); }),
            "a.off: vertex 0 (line 3) lies at infinity: its fourth coordinate is 0.000000.");
}

TEST(OffOfADimension, IsReadWhereThatIsThree) {
  const std::string bytes = "nOFF\n3\n3 1 0\n1 2 3\n-1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read_mesh_bytes(SoupFormat::kOff, bytes, "a.off").mesh.vertices[0], Vec3(1, 2, 3));
  EXPECT_EQ(sentence_of(
                [&] { read_mesh_bytes(SoupFormat::kOff, with(bytes, "\n3\n", "\n4\n"), "a.off"); }),
            "a.off has vertices of 4 dimensions; only those of 3 can be read.");
}

// Of a file of thousands of polygons one that folds is left out, or repaired.
TEST(FoldedPolygon, IsNamedAndLeftOutOrFilledByAFan) {
  const std::string bytes =
      "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nv -1 0.5 0\nf 1 2 3\nf 1 2 3 4 5\nf 1 3 4\n";
  const LoadedMesh left_out = read_mesh_bytes(SoupFormat::kObj, bytes, "a.obj");
  EXPECT_EQ(left_out.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(left_out.unfilled, std::vector<std::size_t>{1});
  EXPECT_EQ(left_out.notes,
            "face 1 (line 7), of 5 corners, crosses or folds back on itself: left out (--repair, "
            "in a scene \"repair\": true, fills it by a fan)");
  const LoadedMesh fanned = read_mesh_bytes(SoupFormat::kObj, bytes, "a.obj", Folded::kFanned);
  EXPECT_EQ(fanned.mesh.triangles,
            (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 2, 3}}));
  EXPECT_TRUE(fanned.unfilled.empty());
  EXPECT_EQ(fanned.notes,
            "face 1 (line 7), of 5 corners, crosses or folds back on itself: filled by a fan");
  const std::string two = bytes + "f 1 2 3 4 5\n";
  EXPECT_EQ(read_mesh_bytes(SoupFormat::kObj, two, "a.obj").notes,
            "2 polygons cross or fold back on themselves, first face 1 (line 7) of 5 corners: left "
            "out (--repair, in a scene \"repair\": true, fills them by fans)");
}

}  // namespace
}  // namespace contactcheck::mesh::variants
