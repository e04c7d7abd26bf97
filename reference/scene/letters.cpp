#include "reference/scene/letters.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/types/check.h"

namespace contactcheck {
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

}  // namespace contactcheck
