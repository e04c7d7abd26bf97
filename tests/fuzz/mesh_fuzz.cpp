// Fuzz target: bytes as OBJ, OFF, PLY and STL in turn, so that the corpus is made of mesh files as
// they are. Whatever is accepted is what mesh_file.h promises, and can be written and read again.

#include <algorithm>
#include <bit>
#include <charconv>
#include <string>

#include "core/types/check.h"
#include "core/types/mesh_topology.h"
#include "reference/mesh/mesh_file.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

void check_promises(const TriangleMesh& mesh) {
  require(!mesh.triangles.empty(), "a mesh that is read has a triangle");
  for (const Vec3& v : mesh.vertices) require(v.allFinite(), "all coordinates are finite");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t index : triangle)
      require(index < mesh.vertices.size(), "all indices are in range");
  require(!analyse_topology(mesh).fatal, "a mesh that is read has no fatal defect");
}

void append(std::string& out, double value) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

std::string as_off(const TriangleMesh& mesh) {
  std::string out = "OFF\n" + std::to_string(mesh.vertices.size()) + ' ' +
                    std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Vec3& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) {
      append(out, v[axis]);
      out += axis == 2 ? '\n' : ' ';
    }
  for (const auto& t : mesh.triangles) {
    out += '3';
    for (const std::uint32_t index : t) out += ' ' + std::to_string(index);
    out += '\n';
  }
  return out;
}

bool same_bits(const Vec3& a, const Vec3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::bit_cast<std::uint64_t>(a[axis]) != std::bit_cast<std::uint64_t>(b[axis]))
      return false;
  return true;
}

// Doubles and indices are kept: what is written as OFF comes back bit for bit.
void check_round_trip(const TriangleMesh& mesh) {
  const TriangleMesh again =
      mesh::read_mesh_bytes(mesh::SoupFormat::kOff, as_off(mesh), "mesh file \"again.off\"").mesh;
  require(std::equal(mesh.vertices.begin(), mesh.vertices.end(), again.vertices.begin(),
                     again.vertices.end(), same_bits),
          "the OFF reader keeps doubles");
  require(again.triangles == mesh.triangles, "the OFF reader keeps indices");
}

void read_as(mesh::SoupFormat format, const std::string& bytes) {
  TriangleMesh mesh;
  try {
    for (const mesh::Folded folded : {mesh::Folded::kFanned, mesh::Folded::kLeftOut})
      mesh = mesh::read_mesh_bytes(format, bytes, "mesh file \"fuzzed\"", folded).mesh;
  } catch (const InputError& refusal) {
    require_sentence(refusal.what());
    return;
  }
  check_promises(mesh);
  check_round_trip(mesh);
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(mesh) {
  using contactcheck::mesh::SoupFormat;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  for (const SoupFormat format :
       {SoupFormat::kObj, SoupFormat::kOff, SoupFormat::kPly, SoupFormat::kStl})
    contactcheck::test::read_as(format, bytes);
  return 0;
}
