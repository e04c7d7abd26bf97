// What is claimed of patches, against a test of every two of their triangles; and that enough is
// claimed to be of use.

#include "core/lazy/embedded_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/narrow/adjacent_triangles.h"
#include "tests/core/lazy/bounds_cases.h"

namespace contactcheck::test {
namespace {

struct Patch {
  std::uint32_t child;  ///< index of PatchTree::children
  std::vector<std::uint32_t> triangles;
};

std::vector<Patch> patches_of(const OneBody& body) {
  std::vector<Patch> out;
  for (std::uint32_t b = 0; b < body.tree().blocks.size(); ++b)
    for (std::uint32_t c = 0; c < body.tree().blocks[b].children; ++c)
      out.push_back({static_cast<std::uint32_t>(b * kBlockWidth + c),
                     triangles_under(body.tree(), body.tree().blocks[b].child[c])});
  return out;
}

bool meet(const OneBody& body, std::uint32_t s, std::uint32_t t) {
  const std::vector<Triangle>& triangles = body.shape().mesh.triangles;
  const auto points = [&](std::uint32_t i) -> TrianglePoints {
    const Triangle& c = triangles[i];
    return {body.vertices()[c[0]], body.vertices()[c[1]], body.vertices()[c[2]]};
  };
  const std::vector<Triangle>& linked = body.shape().linked();
  return meet_beyond_shared(shared_corners(linked[s], linked[t]), points(s), points(t));
}

struct Tally {
  int claimed = 0, refused = 0, meeting = 0;
};

/// Every patch, and every pair of near ones, in this frame.
void check(OneBody& body, const PatchTree& tree, const std::vector<Patch>& patches, Tally& tally) {
  const auto look_at = [&](const Patch& a, const Patch& b) {
    std::vector<std::uint32_t> triangles = a.triangles;
    triangles.insert(triangles.end(), b.triangles.begin(), b.triangles.end());
    if (triangles.size() > 200) return;
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    bool any = false;
    for (std::size_t i = 0; i < triangles.size() && !any; ++i)
      for (std::size_t j = 0; j < i && !any; ++j) any = meet(body, triangles[i], triangles[j]);
    const bool claimed = stays_embedded(body.state(), tree, a.child, b.child);
    EXPECT_FALSE(claimed && any) << "a patch of " << triangles.size() << " triangles meets itself";
    (claimed ? tally.claimed : tally.refused) += 1;
    tally.meeting += any;
  };
  for (const Patch& p : patches) look_at(p, p);
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (std::size_t j = i + 1; j < std::min(patches.size(), i + 12); ++j)
      look_at(patches[i], patches[j]);
}

TEST(EmbeddedPatch, IsNeverClaimedOfTrianglesThatMeet) {
  TriangleSource random(5);
  for (const NamedShape& named : shapes()) {
    if (!named.shape->lattice) continue;
    SCOPED_TRACE(named.name);
    OneBody body(named.shape, false);
    const PatchTree tree = make_patch_tree(*named.shape, body.tree());
    const std::vector<Patch> patches = patches_of(body);
    Tally tally;
    for (const double strength : {0.0, 0.01, 0.05, 0.1, 0.2, 0.4, 1.0})
      for (int repeat = 0; repeat < 3; ++repeat) {
        body.begin(deformed_nodes(*named.shape, {strength, 1.0, Vec3(3, -2, 1)}, random));
        check(body, tree, patches, tally);
      }
    RecordProperty(named.name, tally.claimed);
    EXPECT_GT(tally.refused, 0);
  }
}

// Turned inside out, mirrored, flattened, and far out: what no distance in space tells.
TEST(EmbeddedPatch, IsNeverClaimedOfCellsThatAreInvertedOrFlat) {
  Tally folded;
  for (const NamedShape& named : shapes()) {
    if (!named.shape->lattice) continue;
    SCOPED_TRACE(named.name);
    OneBody body(named.shape, false);
    const PatchTree tree = make_patch_tree(*named.shape, body.tree());
    const std::vector<Patch> patches = patches_of(body);
    Tally scaled;
    for (const Vec3& factor : {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(-1, 1, 1), Vec3(1, 1, 1e-9),
                               Vec3(1e-200, 1e-200, 1e-200), Vec3(1e100, 1e100, 1e100)}) {
      std::vector<Vec3> nodes = rest_nodes_at(*named.shape, Vec3::Zero());
      for (Vec3& n : nodes) n = n.cwiseProduct(factor);
      body.begin(nodes);
      check(body, tree, patches, scaled);
    }
    EXPECT_GT(scaled.meeting, 0) << "flattened triangles lie on each other";
    // Every second layer is folded over its neighbour.
    std::vector<Vec3> nodes = rest_nodes_at(*named.shape, Vec3::Zero());
    const Lattice& lattice = *named.shape->lattice;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const std::uint32_t layer = lattice.nodes[n][0];
      nodes[n].x() = lattice.lines[0][layer % 2];
    }
    body.begin(nodes);
    check(body, tree, patches, folded);
  }
  EXPECT_GT(folded.meeting, 0) << "lattices of one cell cannot fold, others do";
}

TEST(EmbeddedPatch, IsClaimedWhereNothingOrLittleIsBent) {
  const ShapePtr ball = make_shape(sphere_mesh(Vec3::Zero(), 1.0, 5), {6, 6, 6});
  OneBody body(ball, false);
  const PatchTree tree = make_patch_tree(*ball, body.tree());
  for (const double bend : {0.0, 0.1}) {
    std::vector<Vec3> nodes = rest_nodes_at(*ball, Vec3::Zero());
    // Turned by an angle of tangent 3/4, stretched, and bent.
    for (Vec3& n : nodes)
      n = Vec3(0.8 * n.x() - 0.6 * n.y(), 0.6 * n.x() + 0.8 * n.y(), 1.5 * n.z()) +
          bend * Vec3(n.y() * n.y(), 0, n.x() * n.y());
    body.begin(nodes);
    int claimed = 0, all = 0;
    for (std::uint32_t b = 0; b < body.tree().blocks.size(); ++b)
      for (std::uint32_t c = 0; c < body.tree().blocks[b].children; ++c) {
        if (!body.tree().blocks[b].child[c].leaf()) continue;
        const auto child = static_cast<std::uint32_t>(b * kBlockWidth + c);
        claimed += stays_embedded(body.state(), tree, child, child);
        ++all;
      }
    EXPECT_GT(claimed, all * 8 / 10) << "bent by " << bend;
  }
}

// What the lattice does across a flat patch is nothing to it.
TEST(EmbeddedPatch, OfAFlatSheetIsClaimedWhereItsCellsAreFlat) {
  TriangleMesh mesh = sheet(20);
  for (Vec3& v : mesh.vertices) v.z() = 0.0;
  const ShapePtr flat = make_shape(mesh, {2, 2, 1});
  OneBody body(flat, false);
  const PatchTree tree = make_patch_tree(*flat, body.tree());
  const std::vector<Patch> patches = patches_of(body);
  for (const double thickness : {1.0, 0.0, -1.0}) {
    std::vector<Vec3> nodes = rest_nodes_at(*flat, Vec3::Zero());
    for (Vec3& n : nodes) n.z() *= thickness;
    body.begin(nodes);
    Tally tally;
    check(body, tree, patches, tally);
    EXPECT_GT(tally.claimed, 0);
    EXPECT_EQ(tally.refused, 0) << "thickness times " << thickness;
  }
  // Its own directions do count: drawn together along one of them, all triangles lie on one
  // another.
  std::vector<Vec3> nodes = rest_nodes_at(*flat, Vec3::Zero());
  for (Vec3& n : nodes) n.x() = 0.0;
  body.begin(nodes);
  for (const Patch& patch : patches)
    EXPECT_FALSE(stays_embedded(body.state(), tree, patch.child, patch.child));
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
}

// The lattice folds nothing, but triangles are chords of what it bends: two sheets that it keeps
// apart meet, whose triangles are not the same.
TEST(EmbeddedPatch, IsNotClaimedOfSheetsNearerThanTheirTrianglesAreOffTheBentSurface) {
  TriangleMesh mesh;
  for (const auto& [n, height] : {std::pair(4, 0.0), std::pair(5, 1e-4), std::pair(1, 0.5)}) {
    TriangleMesh one = sheet(n);
    for (Vec3& v : one.vertices) v.z() = height;
    append(mesh, one);
  }
  const ShapePtr shape = make_shape(mesh, {1, 1, 1});
  OneBody body(shape, false);
  const PatchTree tree = make_patch_tree(*shape, body.tree());
  std::vector<Vec3> nodes = rest_nodes_at(*shape, Vec3::Zero());
  for (Vec3& n : nodes) n.z() += 0.05 * n.x() * n.y();
  body.begin(nodes);
  Tally tally;
  check(body, tree, patches_of(body), tally);
  EXPECT_GT(tally.meeting, 0);
}

// A hinge, nearly closed at rest, of which one wing is a chord of what is bent: it closes.
TEST(EmbeddedPatch, IsNotClaimedOfAHingeThatTheBendingCloses) {
  constexpr double kBend = 0x1p-4;
  const TriangleMesh hinge = {
      {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(0.5, 0.5, kBend / 4)},
      {{0, 1, 2}, {1, 0, 3}}};
  const ShapePtr shape = make_shape_on_lines(hinge, {{{0, 1}, {0, 1}, {0, 1}}});
  OneBody body(shape, false);
  const PatchTree tree = make_patch_tree(*shape, body.tree());
  std::vector<Vec3> nodes = rest_nodes_at(*shape, Vec3::Zero());
  for (Vec3& n : nodes) n.z() += kBend * n.x() * n.y();
  body.begin(nodes);
  Tally tally;
  check(body, tree, patches_of(body), tally);
  EXPECT_GT(tally.meeting, 0);
}

// Cells that are looked at along an axis, and their neighbours: the first, the last, and those
// about what fits into 8 and 16 bits.
bool is_looked_at(std::uint32_t cell, std::uint32_t cells) {
  for (const std::uint32_t middle : {1u, 255u, 256u, 65535u, 65536u, cells - 1})
    if (cell + 2 >= middle && cell <= middle + 2) return true;
  return false;
}

// The middle surface of a row of cells along an axis, four quads a cell, where it is looked at. The
// others are not kept.
ShapePtr strip(std::uint32_t cells, int axis) {
  TriangleMesh mesh;
  const auto place = [axis](double along, double across) {
    Vec3 out;
    out[axis] = along, out[(axis + 1) % 3] = across, out[(axis + 2) % 3] = 0.5;
    return out;
  };
  bool joined = false;
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    if (!is_looked_at(cell, cells)) {
      joined = false;
      continue;
    }
    for (std::uint32_t quad = 0; quad <= 4; ++quad) {
      if (quad == 0 && joined) continue;
      for (const double across : {0.0, 1.0})
        mesh.vertices.push_back(place(cell + quad / 4.0, across));
      if (quad == 0) continue;
      const auto a = static_cast<std::uint32_t>(mesh.vertices.size() - 4);
      mesh.triangles.push_back({a, a + 2, a + 3});
      mesh.triangles.push_back({a, a + 3, a + 1});
    }
    joined = true;
  }
  std::array<std::vector<double>, 3> lines{{{0, 1}, {0, 1}, {0, 1}}};
  lines[axis].resize(cells + 1);
  for (std::uint32_t i = 0; i <= cells; ++i) lines[axis][i] = i;
  return make_shape_on_lines(mesh, lines);
}

// Positions of cells were kept in 8 bits: what cell 256 does was looked up in cell 0. Here one cell
// is twisted by half a turn, which draws its middle together to a point; all others are as at rest.
TEST(EmbeddedPatch, IsNotClaimedOfATwistedCellWhereverItIsAlongAnAxis) {
  for (const std::uint32_t cells : {255u, 256u, 257u, 300u, 65535u, 65536u, 65537u})
    for (const int axis : {0, 1, 2}) {
      const ShapePtr shape = strip(cells, axis);
      OneBody body(shape, false);
      const PatchTree tree = make_patch_tree(*shape, body.tree());
      const std::vector<Patch> patches = patches_of(body);
      for (const std::uint32_t twisted : {1u, 254u, 255u, 256u, 257u, 65534u, 65535u, 65536u}) {
        if (twisted >= cells || !is_looked_at(twisted, cells)) continue;
        SCOPED_TRACE("cell " + std::to_string(twisted) + " of " + std::to_string(cells) +
                     " along axis " + std::to_string(axis));
        std::vector<Vec3> nodes = rest_nodes_at(*shape, Vec3::Zero());
        for (Vec3& n : nodes)
          if (n[axis] > twisted)
            for (const int k : {(axis + 1) % 3, (axis + 2) % 3}) n[k] = 1.0 - n[k];
        body.begin(nodes);
        int here = 0, claimed = 0;
        for (const Patch& patch : patches) {
          const bool in_it =
              std::any_of(patch.triangles.begin(), patch.triangles.end(), [&](std::uint32_t t) {
                const Vec3& corner = shape->mesh.vertices[shape->mesh.triangles[t][0]];
                return corner[axis] >= twisted && corner[axis] < twisted + 1;
              });
          const bool says = stays_embedded(body.state(), tree, patch.child, patch.child);
          EXPECT_FALSE(in_it && says);
          here += in_it;
          claimed += says;
        }
        EXPECT_GT(here, 0);
        // Farther out, cells are too small for floats in the frame of the body.
        EXPECT_TRUE(claimed > 0 || cells > 300) << "of the others";
      }
    }
}

// Squares of such lengths are no floats, of the largest no doubles either: what was asked of them
// came out as 0, and held. Powers of two change no digit.
TEST(EmbeddedPatch, OfABodyOfAnySizeAtRestIsClaimedAsOfOneOfAMetre) {
  std::vector<Tally> tallies;
  for (const double size : {1.0, 0x1p-900, 0x1p-540, 0x1p-75, 0x1p80, 0x1p130, 0x1p540, 0x1p1000}) {
    SCOPED_TRACE(size);
    TriangleSource random(7);
    TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 3);
    for (Vec3& v : mesh.vertices) v *= size;
    const ShapePtr ball = make_shape(mesh, {4, 4, 4});
    OneBody body(ball, false);
    const PatchTree tree = make_patch_tree(*ball, body.tree());
    const std::vector<Patch> patches = patches_of(body);
    Tally& tally = tallies.emplace_back();
    for (const double strength : {0.0, 0.03, 0.6}) {
      std::vector<Vec3> nodes = rest_nodes_at(*ball, Vec3::Zero());
      // A metre large in its frame, whatever it is at rest.
      for (Vec3& n : nodes) n = random.point(n / size, strength);
      body.begin(nodes);
      check(body, tree, patches, tally);
    }
    EXPECT_GT(tally.meeting, 0);
    EXPECT_GT(tally.claimed, 0);
    // Areas leave the range of doubles farther out, and the tree is another one.
    if (std::abs(std::log2(size)) > 500) continue;
    EXPECT_EQ(tally.claimed, tallies[0].claimed);
    EXPECT_EQ(tally.refused, tallies[0].refused);
    EXPECT_EQ(tally.meeting, tallies[0].meeting);
  }
}

TEST(EmbeddedPatch, OfTrianglesThatTouchAtRestNothingIsClaimed) {
  TriangleMesh mesh = sheet(5);
  append(mesh, sheet(5));  // at the same place, and not welded
  const ShapePtr shape = make_shape(mesh, {3, 3, 1});
  OneBody body(shape, false);
  const PatchTree tree = make_patch_tree(*shape, body.tree());
  body.begin(rest_nodes_at(*shape, Vec3::Zero()));
  for (const Patch& patch : patches_of(body))
    EXPECT_FALSE(stays_embedded(body.state(), tree, patch.child, patch.child));
}

}  // namespace
}  // namespace contactcheck::test
