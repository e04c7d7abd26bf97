// print_vertices RECORDING FRAME: the deformed vertices of a frame as the program maps them, one
// per line, body after body: x, y, z as hex floats. What recording.py must give bit for bit.
#include <charconv>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "core/deform/recording.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

void print_vertices(const Body& body, const std::vector<Vec3>& nodes) {
  std::vector<Vec3> vertices(body.shape->mesh.vertices.size());
  map_body(*body.shape, nodes, vertices);
  for (const Vec3& v : vertices) std::printf("%a %a %a\n", v.x(), v.y(), v.z());
}

std::size_t frame_number(std::string_view text, std::size_t frames) {
  std::size_t frame = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), frame);
  if (error != std::errc() || end != text.data() + text.size() || frame >= frames) {
    throw InputError("there is no frame \"" + std::string(text) + "\" among the " +
                     std::to_string(frames) + " of the recording.");
  }
  return frame;
}

int run(const char* file, std::string_view frame_text) {
  const Recording recording = read_recording(file);
  const std::size_t frame = frame_number(frame_text, recording.frames.size());
  for (std::size_t b = 0; b < recording.bodies.size(); ++b) {
    print_vertices(recording.bodies[b], recording.frames[frame][b]);
  }
  return 0;
}

}  // namespace
}  // namespace contactcheck

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: print_vertices RECORDING FRAME\n");
    return 2;
  }
  try {
    return contactcheck::run(argv[1], argv[2]);
  } catch (const contactcheck::InputError& error) {
    std::fprintf(stderr, "print_vertices: %s\n", error.what());
    return 2;
  }
}
