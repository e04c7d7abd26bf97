#include "reference/certify/ply.h"

#include "core/deform/byte_stream.h"

namespace contactcheck::certify {

std::string ply_bytes(std::span<const Vec3> vertices, const std::vector<Triangle>& triangles,
                      const std::string& comment) {
  ByteWriter out;
  out.raw("ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " +
          std::to_string(vertices.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
          std::to_string(triangles.size()) +
          "\nproperty list uchar int vertex_indices\nend_header\n");
  for (const Vec3& v : vertices)
    for (int axis = 0; axis < 3; ++axis) out.f64(v[axis]);
  for (const Triangle& t : triangles) {
    out.raw("\3");
    for (std::uint32_t corner : t) out.u32(corner);
  }
  return out.bytes();
}

}  // namespace contactcheck::certify
