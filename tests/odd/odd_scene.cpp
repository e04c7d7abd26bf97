#include "tests/odd/odd_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
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
    const int kind = random_.below(12);
    const int count = kind == 0 ? 100 + random_.below(150) : 1 + kind % 3;
    out.description = std::to_string(count) + " bodies";
    // Of all bodies; frames have a size of their own.
    size_ = power_of_two(exponent());
    for (int b = 0; b < count; ++b) add_body(count > 3, out);
    const int frames = count > 3 ? 1 : 2;
    while (static_cast<int>(out.frames.size()) < frames) add_frame(out);
    return out;
  }

 private:
  int exponent() {
    constexpr int kExponents[] = {0,   0,  0,    0,   0,    3,   -20,  20,
                                  -75, 76, -130, 130, -600, 600, -900, 1000};
    return kExponents[random_.below(static_cast<int>(std::size(kExponents)))];
  }

  TriangleMesh mesh(std::string& name) {
    switch (random_.below(9)) {
      case 0:
        name = "sphere";
        return sphere_mesh(Vec3::Zero(), 1.0, 1 + random_.below(3));
      case 1:
        name = "box";
        return box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1 + random_.below(5));
      case 2:
        name = "sheet";
        return sheet(1 + random_.below(12), 1 + random_.below(12), 0.0);
      case 3:
        name = "strip";
        return sheet(40 + random_.below(200), 1, 0.0);
      case 4:
        name = "fan";
        return fan(3 + static_cast<std::uint32_t>(random_.below(random_.below(4) == 0 ? 700 : 60)));
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
      default: {
        name = "sheets on one another";
        TriangleMesh out;
        const double gap = power_of_two(-random_.below(20));
        for (int i = 0, sheets = 2 + random_.below(4); i < sheets; ++i)
          append(out, sheet(2 + random_.below(5), 2 + random_.below(5), 0.25 * gap * i));
        return out;
      }
    }
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

  using Lines = std::array<std::vector<double>, 3>;

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

  void add_body(bool small, OddScene& out) {
    while (true) {
      std::string name = "box";
      TriangleMesh body = small ? box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1) : mesh(name);
      stretch(body, name);
      std::shared_ptr<const BodyShape> made;
      try {
        made = shape(std::move(body), name);
      } catch (const InputError&) {
        continue;  // grid lines that doubles cannot tell apart, or a mesh without a proper triangle
      }
      if (!made) continue;
      if (random_.below(6) == 0) {
        made = welded(*made);
        name += ", welded";
      }
      if (!small || out.bodies.empty()) out.description += "; " + name;
      out.bodies.push_back({"body" + std::to_string(out.bodies.size()), made});
      return;
    }
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

  void bend(std::vector<Vec3>& nodes, std::string& name) {
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
        // Beyond one plane all is turned by half a turn.
        const double plane = random_.unit();
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
        Vec3& n = nodes[static_cast<std::size_t>(random_.below(static_cast<int>(nodes.size())))];
        name += " with a spike";
        n = random_.point(n, power_of_two(random_.below(6)));
        return;
      }
    }
  }

  void add_frame(OddScene& out) {
    std::string name = "; frame";
    const double size = power_of_two(exponent());
    const double spread = out.bodies.size() > 3 ? 6.0 : power_of_two(-random_.below(6));
    const Vec3 away = random_.below(4) == 0
                          ? random_.point(Vec3::Zero(), power_of_two(random_.below(24)))
                          : Vec3(Vec3::Zero());
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : out.bodies) {
      nodes.push_back(unit_nodes(*body.shape));
      if (out.bodies.size() <= 3 || nodes.size() == 1) bend(nodes.back(), name);
      const Vec3 place = random_.point(away, spread);
      const double own = random_.below(5) == 0 ? power_of_two(random_.below(20)) : 1.0;
      for (Vec3& n : nodes.back()) n = size * (own * n + place);
    }
    for (const auto& body : nodes)
      for (const Vec3& n : body)
        if (!(n.cwiseAbs().maxCoeff() < power_of_two(1020))) return;
    out.description += name + ", size " + std::to_string(std::ilogb(size));
    out.frames.push_back(make_frame(out.bodies, std::move(nodes)));
  }

  TriangleSource random_;
  double size_ = 1.0;
};

}  // namespace

OddScene odd_scene(std::uint64_t seed) { return Source(seed).scene(); }

}  // namespace contactcheck::test
