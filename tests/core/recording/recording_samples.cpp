#include "tests/core/recording/recording_samples.h"

#include <array>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace contactcheck {

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "contactcheck-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) std::abort();
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::size_t ScratchFolder::file_count() const {
  const std::filesystem::directory_iterator files(path_);
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi) {
  TriangleMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.emplace_back(c & 1 ? hi.x() : lo.x(), c & 2 ? hi.y() : lo.y(),
                               c & 4 ? hi.z() : lo.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh one_triangle() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.1, 0)}, {{0, 1, 2}}};
}

Recording sample_recording() {
  const auto box = make_shape(box_mesh(Vec3(-0.1, -0.2, -0.3), Vec3(0.1, 0.2, 0.3)), {2, 2, 2});
  const auto bare = make_bare_shape(one_triangle());
  Recording out;
  out.scene = "two-boxes";
  out.time_step = 1.0 / 60.0;
  out.bodies = {{"box a", box}, {"flag \xc3\xa9", bare}, {"box b", box}};
  for (int f = 0; f < 2; ++f) {
    std::vector<std::vector<Vec3>> frame = {box->lattice->rest_nodes(), bare->mesh.vertices,
                                            box->lattice->rest_nodes()};
    for (Vec3& node : frame[2]) node += Vec3(0.1 * f, 1e-310, -0.0);
    out.frames.push_back(frame);
  }
  return out;
}

Recording bare_recording() {
  const auto bare = make_bare_shape(one_triangle());
  return {"flag", {{"cloth", bare}}, 0.5, {{bare->mesh.vertices}}};
}

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
}

std::string bytes_of(const Recording& recording) {
  const ScratchFolder folder;
  write_recording(folder.path() / "a.ccr", recording);
  return read_bytes(folder.path() / "a.ccr");
}

Recording recording_of(const std::string& bytes) {
  static const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "case.ccr";
  write_bytes(file, bytes);
  return read_recording(file);
}

std::string u64_bytes(std::uint64_t value) {
  std::string out;
  for (int i = 0; i < 8; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
  return out;
}

std::string u32_bytes(std::uint32_t value) { return u64_bytes(value).substr(0, 4); }

std::string f64_bytes(double value) { return u64_bytes(std::bit_cast<std::uint64_t>(value)); }

void set_u64(std::string& bytes, std::size_t at, std::uint64_t value) {
  bytes.replace(at, 8, u64_bytes(value));
}

std::uint64_t reference_hash(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ull;
  }
  return hash;
}

void seal(std::string& bytes) {
  set_u64(bytes, 16, bytes.size());
  set_u64(bytes, bytes.size() - 8, reference_hash(bytes.substr(0, bytes.size() - 8)));
}

}  // namespace contactcheck
