#include "tests/odd/odd_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "core/types/check.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

double power_of_two(int exponent) { return std::ldexp(1.0, exponent); }

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
}

// Over [-1, 1]^2 at a height.
TriangleMesh sheet(int along, int across, double height) {
  TriangleMesh mesh;
  for (int y = 0; y <= across; ++y)
    for (int x = 0; x <= along; ++x)
      mesh.vertices.push_back({2.0 * x / along - 1.0, 2.0 * y / across - 1.0, height});
  const auto row = static_cast<std::uint32_t>(along + 1);
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(across); ++y)
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = y * row + x;
      mesh.triangles.push_back({a, a + 1, a + row + 1});
      mesh.triangles.push_back({a, a + row + 1, a + row});
    }
  return mesh;
}

// One vertex in all triangles; its rim winds up and down.
TriangleMesh fan(std::uint32_t count) {
  TriangleMesh mesh;
  mesh.vertices.push_back(Vec3::Zero());
  for (std::uint32_t i = 0; i <= count; ++i) {
    const double s = 4.0 * i / count - 2.0;  // round a square
    mesh.vertices.push_back({std::clamp(1.5 - std::abs(s), -1.0, 1.0), std::clamp(s, -1.0, 1.0),
                             i % 2 == 0 ? 0.2 : -0.2});
  }
  for (std::uint32_t i = 1; i <= count; ++i) mesh.triangles.push_back({0, i, i + 1});
  return mesh;
}

class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}

  OddScene scene() {
    OddScene out;
    theme_ = kThemes[random_.below(static_cast<int>(std::size(kThemes)))];
    const int count = theme_ == Theme::kMany      ? 100 + random_.below(100)
                      : theme_ == Theme::kAny     ? 1 + random_.below(3)
                      : theme_ == Theme::kLargest ? 2
                                                  : 1;
    out.description = std::to_string(count) + " bodies";
    // Of all bodies; frames have a size of their own.
    size_ = power_of_two(exponent());
    if (theme_ == Theme::kLargest) size_ = power_of_two(1000);
    // Whose squares are no floats; the patches of a stack are told apart by such.
    if (theme_ == Theme::kStack && random_.below(2) == 0)
      size_ = power_of_two(76 + random_.below(40));
    if (size_ != 1.0) out.description += " of 2^" + std::to_string(std::ilogb(size_)) + " m";
    for (int b = 0; b < count; ++b) add_body(out);
    const std::size_t frames = theme_ == Theme::kMany ? 1 : 2;
    while (out.frames.size() < frames) add_frame(out);
    return out;
  }

 private:
  enum class Theme {
    kAny,
    kMany,     ///< small bodies
    kStack,    ///< sheets on one another, bent by about their distance
    kRow,      ///< pieces in two parts of a long row of cells
    kLargest,  ///< two bodies at the largest double
  };
  using Lines = std::array<std::vector<double>, 3>;
  static constexpr Theme kThemes[] = {Theme::kAny,   Theme::kAny, Theme::kAny,  Theme::kAny,
                                      Theme::kAny,   Theme::kAny, Theme::kMany, Theme::kStack,
                                      Theme::kStack, Theme::kRow, Theme::kRow,  Theme::kLargest};

  int exponent() {
    constexpr int kExponents[] = {0,   0,  0,    0,   0,    3,   -20,  20,
                                  -75, 76, -130, 130, -600, 600, -900, 1000};
    return kExponents[random_.below(static_cast<int>(std::size(kExponents)))];
  }

  TriangleMesh mesh(std::string& name) {
    switch (random_.below(9)) {
      case 0:
        name = "sphere";
        return sphere_mesh(Vec3::Zero(), 1.0, 1 + random_.below(2));
      case 1:
        name = "box";
        return box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1 + random_.below(5));
      case 2:
        name = "sheet";
        return sheet(1 + random_.below(12), 1 + random_.below(12), 0.0);
      case 3:
        name = "strip";
        return sheet(20 + random_.below(60), 1, 0.0);
      case 4:
        name = "fan";
        return fan(3 +
                   static_cast<std::uint32_t>(random_.below(random_.below(10) == 0 ? 500 : 40)));
      case 5: {
        name = "long triangles";
        TriangleMesh out;
        const int count = 2 + random_.below(40);
        for (int i = 0; i < count; ++i) {
          const TrianglePoints t = random_.triangle(Vec3::Zero(), 1.0);
          append(out, triangle_mesh(t[0], t[1], t[2]));
        }
        return out;
      }
      case 6: {
        name = "triangles on a grid";
        TriangleMesh out;
        const int count = 2 + random_.below(30);
        for (int i = 0; i < count; ++i) {
          const TrianglePoints t = random_.grid_triangle(2);
          append(out, triangle_mesh(0.5 * t[0], 0.5 * t[1], 0.5 * t[2]));
        }
        return out;
      }
      case 7: {
        name = "a sphere and a large triangle";
        TriangleMesh out = sphere_mesh(Vec3::Zero(), power_of_two(-random_.below(30)), 2);
        append(out, triangle_mesh(Vec3(-1, -1, 0.1), Vec3(1, -1, 0.1), Vec3(0, 1, -0.2)));
        return out;
      }
      default:
        return stack(name);
    }
  }

  TriangleMesh stack(std::string& name) {
    name = "sheets on one another";
    TriangleMesh out;
    gap_ = power_of_two(-2 - random_.below(10));
    for (int i = 0, sheets = 2 + random_.below(4); i < sheets; ++i)
      append(out, sheet(1 + random_.below(5), 1 + random_.below(5), gap_ * i));
    return out;
  }

  // Two pieces of a strip, in cells whose positions differ by what a narrow integer leaves out.
  std::shared_ptr<const BodyShape> row(std::string& name) {
    const int axis = random_.below(3);
    const auto apart = static_cast<std::uint32_t>(random_.below(8) == 0 ? 65536 : 256);
    const auto first = static_cast<std::uint32_t>(random_.below(30));
    TriangleMesh mesh;
    for (const std::uint32_t begin : {first, first + apart}) {
      TriangleMesh piece = sheet(12, 1 + random_.below(3), 0.5);  // in three cells
      for (Vec3& v : piece.vertices) {
        const Vec3 at(begin + 1.5 * (v.x() + 1.0), 0.5 * (v.y() + 1.0), v.z());
        for (int k = 0; k < 3; ++k) v[(axis + k) % 3] = at[k];
      }
      append(mesh, piece);
    }
    Lines lines{{{0, 1}, {0, 1}, {0, 1}}};
    lines[axis].resize(first + apart + 4);
    for (std::size_t i = 0; i < lines[axis].size(); ++i) lines[axis][i] = static_cast<double>(i);
    name = "two pieces in a row of " + std::to_string(lines[axis].size() - 1) + " cells";
    return make_shape_on_lines(std::move(mesh), std::move(lines));
  }

  // Thin along some axes, and not at the origin.
  void stretch(TriangleMesh& mesh, std::string& name) {
    Vec3 factor = Vec3::Ones(), offset = Vec3::Zero();
    if (random_.below(3) == 0) {
      factor[random_.below(3)] = power_of_two(-random_.below(40));
      name += ", thin";
    }
    if (random_.below(4) == 0) {
      offset = random_.point(Vec3::Zero(), power_of_two(random_.below(30)));
      name += ", far out";
    }
    for (Vec3& v : mesh.vertices) v = size_ * (v.cwiseProduct(factor) + offset);
  }

  // Cells of very different widths; or of a width to which the body is a point.
  std::optional<Lines> lines_about(const TriangleMesh& mesh, bool wide) {
    Aabb box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const double side = box.extent().maxCoeff();
    Lines out;
    for (int k = 0; k < 3; ++k) {
      const double margin = wide ? side * power_of_two(random_.below(48)) : 0.01 * side;
      const double lo = box.lo[k] - margin, hi = box.hi[k] + margin;
      std::vector<double>& lines = out[k];
      lines = {lo, hi};
      const int inner = wide ? random_.below(2) : random_.below(9);
      for (int i = 0; i < inner; ++i) {
        const double near = power_of_two(-random_.below(30));
        lines.push_back(lo + (hi - lo) * (random_.below(2) == 0 ? near : 1.0 - near));
      }
      std::sort(lines.begin(), lines.end());
      lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
      if (lines.size() < 2 || !std::isfinite(hi - lo)) return std::nullopt;
    }
    return out;
  }

  std::shared_ptr<const BodyShape> shape(TriangleMesh mesh, std::string& name) {
    const auto some = [this](int most) {
      return 1 + static_cast<std::uint32_t>(random_.below(most));
    };
    switch (random_.below(7)) {
      case 0:
        name += ", bare";
        return make_bare_shape(std::move(mesh));
      case 1:
        name += ", in one cell";
        return make_shape(std::move(mesh), {1, 1, 1});
      case 2:
      case 3:
        name += ", in cells";
        return make_shape(std::move(mesh), {some(10), some(10), some(10)});
      case 4: {
        std::array<std::uint32_t, 3> cells = {some(2), some(2), some(2)};
        std::uint32_t& row = cells[random_.below(3)];
        row = 250 + some(random_.below(4) == 0 ? 900 : 60);
        name += ", in a row of " + std::to_string(row) + " cells";
        return make_shape(std::move(mesh), {cells[0], cells[1], cells[2]});
      }
      default: {
        const bool wide = random_.below(2) == 0;
        const std::optional<Lines> lines = lines_about(mesh, wide);
        if (!lines) return nullptr;
        name += wide ? ", in wide cells" : ", in uneven cells";
        return make_shape_on_lines(std::move(mesh), *lines);
      }
    }
  }

  // None where its grid lines cannot be told apart as doubles, or are not finite.
  std::shared_ptr<const BodyShape> body(std::string& name) {
    try {
      if (theme_ == Theme::kRow) return row(name);
      TriangleMesh out;
      if (theme_ == Theme::kMany) {
        name = "box";
        out = box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1);
      } else {
        out = theme_ == Theme::kStack ? stack(name) : mesh(name);
      }
      if (theme_ == Theme::kAny) {
        stretch(out, name);
      } else {
        for (Vec3& v : out.vertices) v *= size_;
      }
      if (theme_ == Theme::kStack && random_.below(2) == 0)
        return make_shape(std::move(out), {1, 1, 1});
      return shape(std::move(out), name);
    } catch (const InputError&) {
      return nullptr;
    }
  }

  void add_body(OddScene& out) {
    std::string name;
    std::shared_ptr<const BodyShape> made;
    while (!made) made = body(name);
    if (random_.below(6) == 0) {
      made = welded(*made);
      name += ", welded";
    }
    if (out.bodies.size() < 3) out.description += "; " + name;
    out.bodies.push_back({"body" + std::to_string(out.bodies.size()), made});
  }

  // Nodes in a frame of a metre: as at rest, about the body's middle.
  std::vector<Vec3> unit_nodes(const BodyShape& shape) {
    std::vector<Vec3> nodes = rest_nodes_at(shape, Vec3::Zero());
    Aabb box;
    for (const Vec3& n : nodes) box.extend(n);
    const Vec3 middle = 0.5 * box.lo + 0.5 * box.hi;
    double half = 0.0;
    for (int k = 0; k < 3; ++k) half = std::max(half, box.hi[k] / 2 - box.lo[k] / 2);
    if (!(half > 0.0)) half = 1.0;
    for (Vec3& n : nodes) n = (n - middle) / half;
    return nodes;
  }

  Vec3& random_node(std::vector<Vec3>& nodes) {
    return nodes[static_cast<std::size_t>(random_.below(static_cast<int>(nodes.size())))];
  }

  void bend(std::vector<Vec3>& nodes, std::string& name) {
    if (theme_ == Theme::kStack && random_.below(3) > 0) {
      const double strength = gap_ * power_of_two(random_.below(6) - 1);
      name += " bent by about the distance of the sheets";
      for (Vec3& n : nodes) n.z() += strength * n.x() * n.y();
      return;
    }
    const int axis = random_.below(3), other = (axis + 1) % 3, third = (axis + 2) % 3;
    switch (random_.below(10)) {
      case 0:
        name += " as at rest";
        return;
      case 1: {
        const double strength = power_of_two(-random_.below(12));
        name += " shaken";
        for (Vec3& n : nodes) n = random_.point(n, strength);
        return;
      }
      case 2: {
        // Folded on itself, many times: layers are next to one another.
        const double width = power_of_two(-random_.below(8)),
                     lift = power_of_two(-random_.below(20));
        name += " folded";
        for (Vec3& n : nodes) {
          const double turns = std::floor(n[axis] / width);
          const double within = n[axis] - turns * width;
          n[axis] = static_cast<long>(turns) % 2 == 0 ? within : width - within;
          n[other] += lift * (turns + 0.5 * n[third]);
        }
        return;
      }
      case 3: {
        // Beyond one plane of nodes all is turned by half a turn.
        const double plane = random_node(nodes)[axis];
        name += " twisted";
        for (Vec3& n : nodes)
          if (n[axis] > plane) n[other] = -n[other], n[third] = -n[third];
        return;
      }
      case 4:
        name += " flattened";
        for (Vec3& n : nodes) n[axis] *= random_.below(2) == 0 ? 0.0 : power_of_two(-60);
        return;
      case 5:
        name += " mirrored";
        for (Vec3& n : nodes) n[axis] = -n[axis];
        return;
      case 6: {
        const double step = power_of_two(-random_.below(4));
        name += " on a grid";
        for (Vec3& n : nodes) n = (n / step).array().round().matrix() * step;
        return;
      }
      case 7: {
        // What the proofs about patches take for nearly nothing.
        const double strength = power_of_two(-4 - random_.below(20));
        name += " bent a little";
        for (Vec3& n : nodes) n[third] += strength * n[axis] * n[other];
        return;
      }
      case 8: {
        name += " sheared";
        const double strength = power_of_two(random_.below(20));
        for (Vec3& n : nodes) n[axis] += strength * n[other];
        return;
      }
      default: {
        // One node alone: all else is as at rest.
        Vec3& n = random_node(nodes);
        name += " with a spike";
        n = random_.point(n, power_of_two(random_.below(6)));
        return;
      }
    }
  }

  // Without a lattice each vertex is moved by itself. A weld that comes apart is refused
  // before detectors are asked (check, run), so that none has to answer for it.
  static void keep_welds(const BodyShape& shape, std::vector<Vec3>& nodes) {
    if (shape.lattice) return;
    for (std::size_t t = 0; t < shape.welded.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c)
        nodes[shape.mesh.triangles[t][c]] = nodes[shape.welded[t][c]];
  }

  void add_frame(OddScene& out) {
    std::string name = "; frame";
    const double size = power_of_two(exponent());
    const bool many = theme_ == Theme::kMany;
    const double spread = many ? 6.0 : power_of_two(-random_.below(6));
    const bool far = theme_ == Theme::kAny && random_.below(4) == 0;
    const Vec3 away =
        far ? random_.point(Vec3::Zero(), power_of_two(random_.below(24))) : Vec3(Vec3::Zero());
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : out.bodies) {
      nodes.push_back(unit_nodes(*body.shape));
      if (!many || nodes.size() == 1) bend(nodes.back(), name);
      keep_welds(*body.shape, nodes.back());
      const Vec3 place = random_.point(away, spread);
      const double own = random_.below(5) == 0 ? power_of_two(random_.below(20)) : 1.0;
      for (Vec3& n : nodes.back()) n = own * n + place;
    }
    double largest = 0.0;
    for (const auto& body : nodes)
      for (const Vec3& n : body) largest = std::max(largest, n.cwiseAbs().maxCoeff());
    const double most =
        std::numeric_limits<double>::max() * (random_.below(2) == 0 ? 1.0 : 1 - 0x1p-30);
    for (auto& body : nodes)
      for (Vec3& n : body)
        n = theme_ == Theme::kLargest
                ? Vec3((2.0 * (n / largest)).cwiseMax(-1.0).cwiseMin(1.0) * most)
                : Vec3(n * size);
    if (theme_ != Theme::kLargest && !(largest * size < power_of_two(1020))) return;
    out.description += name + ", size " +
                       (theme_ == Theme::kLargest ? "of the largest double"
                                                  : "2^" + std::to_string(std::ilogb(size)));
    out.frames.push_back(make_frame(out.bodies, std::move(nodes)));
  }

  TriangleSource random_;
  Theme theme_ = Theme::kAny;
  double size_ = 1.0, gap_ = 1.0;
};

}  // namespace

OddScene odd_scene(std::uint64_t seed) { return Source(seed).scene(); }

}  // namespace contactcheck::test
