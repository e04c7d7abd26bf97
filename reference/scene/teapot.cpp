#include "reference/scene/teapot.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>

#include "core/types/check.h"
#include "reference/scene/file_text.h"

namespace contactcheck {
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
  const std::string name = "teapot file " + in_quotes(file.string());
  const std::string text = read_file_bytes(file, "teapot file");
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
class Welder {
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

void add_patch(const Patch& patch, std::size_t divisions, Welder& welder) {
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

}  // namespace

TriangleMesh make_teapot(std::size_t divisions, const std::vector<std::filesystem::path>& roots) {
  CONTACTCHECK_INVARIANT(divisions > 0, "a patch has at least one square");
  Welder welder;
  for (const Patch& patch : read_patches(find_package_file(roots, kPackage, kFile))) {
    add_patch(patch, divisions, welder);
  }
  return std::move(welder.mesh);
}

}  // namespace contactcheck
