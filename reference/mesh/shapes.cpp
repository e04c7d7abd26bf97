#include "reference/mesh/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "reference/text/file_text.h"

namespace contactcheck::mesh {
namespace {

constexpr std::size_t kColumns = 5, kRows = 7;

// Where a point of the unit square goes. Only square roots: no libm.
using Warp = std::array<double, 2> (*)(double x, double y);

std::array<double, 2> straight(double x, double y) { return {x, y}; }

// Narrower towards the top, as an A is.
std::array<double, 2> pointed(double x, double y) { return {0.5 + (x - 0.5) * (1.0 - 0.6 * y), y}; }

// The square goes to a disc.
std::array<double, 2> round(double x, double y) {
  const double u = 2.0 * x - 1.0, v = 2.0 * y - 1.0;
  return {0.5 + 0.5 * u * std::sqrt(1.0 - 0.5 * v * v),
          0.5 + 0.5 * v * std::sqrt(1.0 - 0.5 * u * u)};
}

// A bowl: full width in the middle of [low, high], 0.7 of it at both ends.
double bowl(double y, double low, double high) {
  const double v = (2.0 * y - low - high) / (high - low);
  return std::sqrt(1.0 - 0.5 * v * v);
}

constexpr double kWaist = 3.5 / 7.0;

std::array<double, 2> one_bowl(double x, double y) { return {x * bowl(y, 0.0, 1.0), y}; }

std::array<double, 2> two_bowls(double x, double y) {
  return {x * (y < kWaist ? bowl(y, 0.0, kWaist) : bowl(y, kWaist, 1.0)), y};
}

// A bowl above the waist; below it a leg that leaves where the bowl ends.
std::array<double, 2> bowl_and_leg(double x, double y) {
  const double start = bowl(kWaist, kWaist, 1.0);
  return {x * (y < kWaist ? start + (1.0 - start) * (1.0 - y / kWaist) : bowl(y, kWaist, 1.0)), y};
}

// No two pixels touch at a corner alone: that would make a non-manifold edge.
struct Glyph {
  char letter;
  std::array<const char*, kRows> rows;  // from the top
  Warp warp;
};

constexpr std::array<Glyph, 13> kGlyphs = {{
    {'A', {"#####", "#...#", "#...#", "#####", "#...#", "#...#", "#...#"}, pointed},
    {'B', {"#####", "#...#", "#...#", "#####", "#...#", "#...#", "#####"}, two_bowls},
    {'C', {"#####", "#...#", "#....", "#....", "#....", "#...#", "#####"}, round},
    {'D', {"#####", "#...#", "#...#", "#...#", "#...#", "#...#", "#####"}, one_bowl},
    {'E', {"#####", "#....", "#....", "####.", "#....", "#....", "#####"}, straight},
    {'H', {"#...#", "#...#", "#...#", "#####", "#...#", "#...#", "#...#"}, straight},
    {'I', {".##..", ".##..", ".##..", ".##..", ".##..", ".##..", ".##.."}, straight},
    {'L', {"#....", "#....", "#....", "#....", "#....", "#....", "#####"}, straight},
    {'O', {"#####", "#...#", "#...#", "#...#", "#...#", "#...#", "#####"}, round},
    {'P', {"#####", "#...#", "#...#", "#####", "#....", "#....", "#...."}, bowl_and_leg},
    {'R', {"#####", "#...#", "#...#", "#####", "#...#", "#...#", "#...#"}, bowl_and_leg},
    {'T', {"#####", "..#..", "..#..", "..#..", "..#..", "..#..", "..#.."}, straight},
    {'U', {"#...#", "#...#", "#...#", "#...#", "#...#", "#...#", "#####"}, straight},
}};

const Glyph& glyph_of(char letter) {
  const auto it = std::find_if(kGlyphs.begin(), kGlyphs.end(),
                               [&](const Glyph& glyph) { return glyph.letter == letter; });
  CONTACTCHECK_INVARIANT(it != kGlyphs.end(), "the letter is a known one");
  return *it;
}

// The grid of squares of a glyph, its rows counted from the bottom, and the vertices made on it.
class Extrusion {
 public:
  Extrusion(const Glyph& glyph, double depth, std::size_t divisions)
      : glyph_(glyph), depth_(depth), divisions_(divisions) {
    const double pixel = 1.0 / static_cast<double>(kRows * divisions);
    layers_ = static_cast<std::size_t>(std::max(1.0, std::round(depth / pixel)));
    numbers_.assign((width() + 1) * (height() + 1) * (layers_ + 1), kNone);
  }

  std::size_t width() const { return kColumns * divisions_; }
  std::size_t height() const { return kRows * divisions_; }
  std::size_t layers() const { return layers_; }

  bool filled(std::ptrdiff_t i, std::ptrdiff_t j) const {
    if (i < 0 || j < 0) return false;
    const std::size_t column = static_cast<std::size_t>(i) / divisions_;
    const std::size_t row = static_cast<std::size_t>(j) / divisions_;
    return column < kColumns && row < kRows && glyph_.rows[kRows - 1 - row][column] == '#';
  }

  std::uint32_t vertex(std::size_t i, std::size_t j, std::size_t layer) {
    std::uint32_t& number = numbers_[(layer * (height() + 1) + j) * (width() + 1) + i];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(place(i, j, layer));
    }
    return number;
  }

  // Two triangles on the diagonal that keeps the smaller one larger: corners of a round glyph are
  // nearly straight, the other diagonal would cut off a sliver.
  void add_quad(const std::array<std::uint32_t, 4>& q) {
    const auto area = [&](int a, int b, int c) {
      const Vec3 &p = mesh.vertices[q[a]], &u = mesh.vertices[q[b]], &v = mesh.vertices[q[c]];
      return (u - p).cross(v - p).squaredNorm();
    };
    const bool across =
        std::min(area(0, 1, 3), area(1, 2, 3)) > std::min(area(0, 1, 2), area(0, 2, 3));
    if (across) {
      mesh.triangles.push_back({q[0], q[1], q[3]});
      mesh.triangles.push_back({q[1], q[2], q[3]});
    } else {
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    }
  }

  TriangleMesh mesh;

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  Vec3 place(std::size_t i, std::size_t j, std::size_t layer) const {
    const auto fraction = [](std::size_t a, std::size_t b) {
      return static_cast<double>(a) / static_cast<double>(b);
    };
    const auto [x, y] = glyph_.warp(fraction(i, width()), fraction(j, height()));
    constexpr double kAspect = static_cast<double>(kColumns) / kRows;
    return {kAspect * (x - 0.5), y - 0.5, depth_ * (fraction(layer, layers_) - 0.5)};
  }

  const Glyph& glyph_;
  double depth_;
  std::size_t divisions_, layers_ = 1;
  std::vector<std::uint32_t> numbers_;
};

// The walls over one side of a square, from corner p to corner q with the square on the left.
void add_wall(Extrusion& out, const std::array<std::size_t, 2>& p,
              const std::array<std::size_t, 2>& q) {
  for (std::size_t layer = 0; layer < out.layers(); ++layer) {
    out.add_quad({out.vertex(p[0], p[1], layer), out.vertex(q[0], q[1], layer),
                  out.vertex(q[0], q[1], layer + 1), out.vertex(p[0], p[1], layer + 1)});
  }
}

void add_square(Extrusion& out, std::size_t i, std::size_t j) {
  const std::array<std::array<std::size_t, 2>, 4> corners = {
      {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
  std::array<std::uint32_t, 4> front, back;
  for (int c = 0; c < 4; ++c) {
    front[c] = out.vertex(corners[c][0], corners[c][1], out.layers());
    back[3 - c] = out.vertex(corners[c][0], corners[c][1], 0);
  }
  out.add_quad(front);
  out.add_quad(back);
  const auto x = static_cast<std::ptrdiff_t>(i), y = static_cast<std::ptrdiff_t>(j);
  const std::array<std::array<std::ptrdiff_t, 2>, 4> beyond = {
      {{x, y - 1}, {x + 1, y}, {x, y + 1}, {x - 1, y}}};
  for (int side = 0; side < 4; ++side) {
    if (!out.filled(beyond[side][0], beyond[side][1])) {
      add_wall(out, corners[side], corners[(side + 1) % 4]);
    }
  }
}

}  // namespace

const std::string& known_letters() {
  static const std::string letters = [] {
    std::string out;
    for (const Glyph& glyph : kGlyphs) out += glyph.letter;
    return out;
  }();
  return letters;
}

TriangleMesh make_letter(char letter, double depth, std::size_t divisions) {
  CONTACTCHECK_INVARIANT(depth > 0.0 && divisions > 0, "a letter has a depth");
  Extrusion out(glyph_of(letter), depth, divisions);
  for (std::size_t j = 0; j < out.height(); ++j) {
    for (std::size_t i = 0; i < out.width(); ++i) {
      if (out.filled(static_cast<std::ptrdiff_t>(i), static_cast<std::ptrdiff_t>(j))) {
        add_square(out, i, j);
      }
    }
  }
  return std::move(out.mesh);
}

namespace {

constexpr const char* kPackage = "povray-examples";
constexpr const char* kFile = "usr/share/doc/povray/examples/advanced/teapot/teapot.inc";
constexpr std::size_t kPatches = 32;

using Patch = std::array<std::array<Vec3, 4>, 4>;

Patch parse_patch(const std::string& text, std::size_t& at, const std::string& name) {
  Patch patch;
  for (int i = 0; i < 16; ++i) {
    at = text.find('<', at);
    double x = 0.0, y = 0.0, z = 0.0;
    if (at == std::string::npos ||
        std::sscanf(text.c_str() + at, "<%lf , %lf , %lf>", &x, &y, &z) != 3) {
      throw InputError(name + " has a bicubic patch without 16 points.");
    }
    patch[i / 4][i % 4] = Vec3(x, y, z);
    ++at;
  }
  return patch;
}

std::vector<Patch> read_patches(const std::filesystem::path& file) {
  const std::string name = "teapot file " + text::in_quotes(file.string());
  const std::string text = text::read_file_bytes(file, "teapot file");
  const std::string keyword = "bicubic_patch";
  std::vector<Patch> patches;
  for (std::size_t at = text.find(keyword); at != std::string::npos; at = text.find(keyword, at)) {
    patches.push_back(parse_patch(text, at, name));
  }
  if (patches.size() != kPatches) {
    throw InputError(name + " has " + std::to_string(patches.size()) +
                     " bicubic patches; the teapot has 32.");
  }
  return patches;
}

Vec3 bezier(const std::array<Vec3, 4>& p, double t) {
  const double s = 1.0 - t;
  return s * s * s * p[0] + 3.0 * s * s * t * p[1] + 3.0 * s * t * t * p[2] + t * t * t * p[3];
}

Vec3 point_on(const Patch& patch, double u, double v) {
  std::array<Vec3, 4> curve;
  for (int i = 0; i < 4; ++i) curve[i] = bezier(patch[i], v);
  return bezier(curve, u);
}

// Vertices within the weld distance become the one that came first. A vertex is found through the
// 27 buckets round it, each as wide as the weld distance.
class PatchWelder {
 public:
  std::uint32_t vertex(const Vec3& p) {
    const Bucket home = bucket_of(p);
    for (int i = 0; i < 27; ++i) {
      const auto it =
          buckets_.find({home[0] + i % 3 - 1, home[1] + i / 3 % 3 - 1, home[2] + i / 9 - 1});
      if (it == buckets_.end()) continue;
      for (const std::uint32_t v : it->second) {
        if ((mesh.vertices[v] - p).cwiseAbs().maxCoeff() <= kTeapotWeld) return v;
      }
    }
    const auto number = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(p);
    buckets_[home].push_back(number);
    return number;
  }

  TriangleMesh mesh;

 private:
  using Bucket = std::array<std::int64_t, 3>;

  static Bucket bucket_of(const Vec3& p) {
    Bucket bucket;
    for (int k = 0; k < 3; ++k)
      bucket[k] = static_cast<std::int64_t>(std::floor(p[k] / kTeapotWeld));
    return bucket;
  }

  std::map<Bucket, std::vector<std::uint32_t>> buckets_;
};

void add_patch(const Patch& patch, std::size_t divisions, PatchWelder& welder) {
  std::vector<std::uint32_t> grid;
  const std::size_t points = divisions + 1;
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t j = 0; j < points; ++j) {
      const double u = static_cast<double>(i) / static_cast<double>(divisions);
      const double v = static_cast<double>(j) / static_cast<double>(divisions);
      grid.push_back(welder.vertex(point_on(patch, u, v)));
    }
  }
  for (std::size_t i = 0; i < divisions; ++i) {
    for (std::size_t j = 0; j < divisions; ++j) {
      const std::size_t at = i * points + j;
      const std::uint32_t a = grid[at], b = grid[at + points], c = grid[at + points + 1],
                          d = grid[at + 1];
      welder.mesh.triangles.push_back({a, b, c});
      welder.mesh.triangles.push_back({a, c, d});
    }
  }
}

// Every `part` triangles with vertices of their own, at the same places.
TriangleMesh torn_apart(const TriangleMesh& mesh, std::size_t part) {
  TriangleMesh out;
  std::map<std::uint32_t, std::uint32_t> own;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % part == 0) own.clear();
    Triangle triangle = mesh.triangles[t];
    for (std::uint32_t& vertex : triangle) {
      const auto next = static_cast<std::uint32_t>(out.vertices.size());
      const auto [known, fresh] = own.try_emplace(vertex, next);
      if (fresh) out.vertices.push_back(mesh.vertices[vertex]);
      vertex = known->second;
    }
    out.triangles.push_back(triangle);
  }
  return out;
}

}  // namespace

TriangleMesh make_teapot(std::size_t divisions, const std::vector<std::filesystem::path>& roots,
                         bool seams) {
  CONTACTCHECK_INVARIANT(divisions > 0, "a patch has at least one square");
  PatchWelder welder;
  for (const Patch& patch : read_patches(find_package_file(roots, kPackage, kFile))) {
    add_patch(patch, divisions, welder);
  }
  return seams ? torn_apart(welder.mesh, 2 * divisions * divisions) : std::move(welder.mesh);
}

namespace {

// Taylor's series for 0 <= angle <= pi/4 in a fixed order of operations; the first term left out,
// angle^19 / 19!, is below 1e-19.
CirclePoint small_angle(double angle) {
  const double square = angle * angle;
  double cosine = 1.0, sine = 1.0;
  for (int term = 18; term >= 2; term -= 2) cosine = 1.0 - square / (term * (term - 1)) * cosine;
  for (int term = 19; term >= 3; term -= 2) sine = 1.0 - square / (term * (term - 1)) * sine;
  return {cosine, angle * sine};
}

}  // namespace

CirclePoint circle_point(std::size_t k, std::size_t n) {
  CONTACTCHECK_INVARIANT(n > 0, "a circle has at least one step");
  const std::size_t eighths = 8 * (k % n);
  const std::size_t octant = eighths / n, rest = eighths % n;
  // Odd octants run backwards from the next quarter, so that mirrored points get mirrored bits.
  const std::size_t part = octant % 2 == 0 ? rest : n - rest;
  const double fraction = static_cast<double>(part) / static_cast<double>(n);
  // On a diagonal the series would give two values an ulp apart.
  const double diagonal = std::sqrt(0.5);
  CirclePoint p =
      part == n ? CirclePoint{diagonal, diagonal} : small_angle(0.25 * std::numbers::pi * fraction);
  if (octant % 4 == 1 || octant % 4 == 2) std::swap(p.cosine, p.sine);
  if (octant >= 2 && octant <= 5) p.cosine = -p.cosine;
  if (octant >= 4) p.sine = -p.sine;
  return p;
}

namespace {

using GridPoint = std::array<std::size_t, 3>;

// Numbers the points of a box's surface grid as they are asked for.
class BoxGrid {
 public:
  BoxGrid(const Vec3& sides, std::size_t divisions) : sides_(sides), divisions_(divisions) {}

  std::uint32_t vertex(const GridPoint& at) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [it, is_new] = index_.try_emplace(at, next);
    if (is_new) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) {
        const double fraction = static_cast<double>(at[k]) / static_cast<double>(divisions_);
        p[k] = sides_[k] * (fraction - 0.5);
      }
      mesh.vertices.push_back(p);
    }
    return it->second;
  }

  TriangleMesh mesh;

 private:
  Vec3 sides_;
  std::size_t divisions_;
  std::map<GridPoint, std::uint32_t> index_;
};

// One face across `axis`, at its low or high end. The two other axes run so that the face's
// counter-clockwise side looks outwards.
void add_face(BoxGrid& grid, int axis, bool high, std::size_t divisions) {
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (!high) std::swap(u, v);
  const auto at = [&](std::size_t i, std::size_t j) {
    GridPoint p;
    p[axis] = high ? divisions : 0;
    p[u] = i;
    p[v] = j;
    return grid.vertex(p);
  };
  for (std::size_t i = 0; i < divisions; ++i) {
    for (std::size_t j = 0; j < divisions; ++j) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      grid.mesh.triangles.push_back({a, b, c});
      grid.mesh.triangles.push_back({a, c, d});
    }
  }
}

TriangleMesh icosahedron() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  for (const double s : {-1.0, 1.0}) {
    for (const double g : {-golden, golden}) {
      mesh.vertices.emplace_back(0.0, s, g);  // 0, 3, 6, 9
      mesh.vertices.emplace_back(s, g, 0.0);  // 1, 4, 7, 10
      mesh.vertices.emplace_back(g, 0.0, s);  // 2, 5, 8, 11
    }
  }
  // The faces are the vertex triples at edge length 2, turned outwards.
  const auto edge = [&](std::uint32_t a, std::uint32_t b) {
    return std::abs((mesh.vertices[a] - mesh.vertices[b]).squaredNorm() - 4.0) < 1e-6;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!edge(a, b) || !edge(b, c) || !edge(c, a)) continue;
        const Vec3 normal =
            (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
        const bool outward = normal.dot(mesh.vertices[a]) > 0.0;
        mesh.triangles.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
      }
    }
  }
  return mesh;
}

TriangleMesh split_in_four(const TriangleMesh& in) {
  TriangleMesh out;
  out.vertices = in.vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(out.vertices.size());
    const auto [it, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, next);
    if (is_new) out.vertices.push_back((out.vertices[a] + out.vertices[b]).normalized());
    return it->second;
  };
  for (const Triangle& t : in.triangles) {
    const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    out.triangles.insert(out.triangles.end(),
                         {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
  }
  return out;
}

}  // namespace

TriangleMesh make_box(const Vec3& sides, std::size_t divisions) {
  CONTACTCHECK_INVARIANT(divisions > 0 && (sides.array() > 0.0).all(), "a box has a size");
  BoxGrid grid(sides, divisions);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) add_face(grid, axis, high, divisions);
  }
  return std::move(grid.mesh);
}

TriangleMesh make_sphere(std::size_t divisions) {
  TriangleMesh mesh = icosahedron();
  for (Vec3& v : mesh.vertices) v.normalize();
  for (std::size_t i = 0; i < divisions; ++i) mesh = split_in_four(mesh);
  for (Vec3& v : mesh.vertices) v *= 0.5;
  return mesh;
}

TriangleMesh make_torus(double tube, std::size_t divisions) {
  CONTACTCHECK_INVARIANT(divisions >= 3 && tube > 0.0 && tube < 1.0, "a torus has a hole");
  const std::size_t ring_steps = 2 * divisions, tube_steps = divisions;
  const double ring_radius = 0.5 / (1.0 + tube), tube_radius = tube * ring_radius;
  TriangleMesh mesh;
  for (std::size_t i = 0; i < ring_steps; ++i) {
    const CirclePoint along = circle_point(i, ring_steps);
    for (std::size_t j = 0; j < tube_steps; ++j) {
      const CirclePoint across = circle_point(j, tube_steps);
      const double radius = ring_radius + tube_radius * across.cosine;
      mesh.vertices.emplace_back(radius * along.cosine, radius * along.sine,
                                 tube_radius * across.sine);
    }
  }
  const auto at = [&](std::size_t i, std::size_t j) {
    return static_cast<std::uint32_t>(i % ring_steps * tube_steps + j % tube_steps);
  };
  for (std::size_t i = 0; i < ring_steps; ++i) {
    for (std::size_t j = 0; j < tube_steps; ++j) {
      const Triangle lower = {at(i, j), at(i + 1, j), at(i + 1, j + 1)};
      mesh.triangles.push_back(lower);
      mesh.triangles.push_back({lower[0], lower[2], at(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh make_sheet(double length, std::size_t divisions) {
  CONTACTCHECK_INVARIANT(divisions >= 1 && length > 0.0, "a sheet has a size");
  const std::size_t line = divisions + 1;
  const auto along = [&](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(divisions) - 0.5;
  };
  TriangleMesh mesh;
  for (std::size_t j = 0; j < line; ++j)
    for (std::size_t i = 0; i < line; ++i)
      mesh.vertices.emplace_back(along(i), 0.0, length * along(j));
  for (std::size_t j = 0; j < divisions; ++j)
    for (std::size_t i = 0; i < divisions; ++i) {
      const auto corner = static_cast<std::uint32_t>(j * line + i);
      const auto next = static_cast<std::uint32_t>(corner + line);
      mesh.triangles.push_back({corner, next, next + 1});
      mesh.triangles.push_back({corner, next + 1, corner + 1});
    }
  return mesh;
}

}  // namespace contactcheck::mesh
