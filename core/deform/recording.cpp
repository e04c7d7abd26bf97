// The byte layout is fixtures/README.md, "Recordings (.ccr)"; reader and writer below follow it
// line by line. Order of the checks when reading: the frame of the file (magic, version, size,
// hash), then every count against the bytes left, then meaning (shape_check.h). Nothing is
// allocated for a count that the file could not fill.
#include "core/deform/recording.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>

#include "core/deform/atomic_file.h"
#include "core/deform/byte_stream.h"
#include "core/deform/name_check.h"
#include "core/deform/shape_check.h"
#include "core/types/check.h"
#include "core/types/input_file.h"

namespace contactcheck {
namespace {

// A line end of each kind and a byte above 127: what a transfer in text mode changes.
constexpr std::string_view kMagic(
    "\x89"
    "CCR\r\n\x1a\n",
    8);
// Version 2 is written only for what version 1 cannot store: levels, and welded meshes.
constexpr std::uint64_t kPlainVersion = 1, kVersion = 2;
constexpr std::uint64_t kHasLattice = 1, kIsWelded = 2;
constexpr std::size_t kHeaderSize = 24, kHashSize = 8;
constexpr std::size_t kSmallestFile = kHeaderSize + kHashSize;

std::string scene_fault(std::string_view scene) {
  if (scene == "." || scene == ".." || scene.find_first_of("/\\") != std::string_view::npos) {
    return "cannot be part of a file name";
  }
  return name_fault(scene);
}

// --- writing ---

void write_lattice(const Lattice& lattice, const Embedding& embedding, const GivenVertices& given,
                   ByteWriter& out) {
  for (const std::vector<double>& lines : lattice.lines) {
    out.u64(lines.size());
    out.doubles(lines);
  }
  out.u64(lattice.cells.size());
  out.u32_rows(lattice.cells);
  out.u64(lattice.nodes.size());
  out.u32_rows(lattice.nodes);
  out.u32_rows(lattice.cell_nodes);
  out.u32s(given.spread(embedding.home_cell));
  out.points(given.spread(embedding.local));
  out.u32s(embedding.label_begin);
  out.u64(embedding.label_cells.size());
  out.u32s(embedding.label_cells);
}

std::string shape_bytes(const BodyShape& shape) {
  ByteWriter out;
  out.u64(shape.given_vertex_count());
  out.points(shape.given.spread(shape.mesh.vertices));
  out.u64(shape.mesh.triangles.size());
  out.u32_rows(shape.given.numbered(shape.mesh.triangles));
  out.u64((shape.lattice ? kHasLattice : 0) | (shape.welded.empty() ? 0 : kIsWelded));
  if (shape.lattice) write_lattice(*shape.lattice, shape.embedding, shape.given, out);
  return out.bytes();
}

// The distinct shapes in order of first use, and the number of each body's shape. Equal content is
// one shape, whether or not the bodies share the object.
struct ShapeTable {
  std::vector<std::string> shapes;
  std::vector<std::size_t> shape_of_body;
};

ShapeTable collect_shapes(const std::vector<Body>& bodies) {
  ShapeTable table;
  std::map<const BodyShape*, std::size_t> by_object;
  std::map<std::string, std::size_t> by_content;
  for (const Body& body : bodies) {
    const auto [object, unseen] = by_object.try_emplace(body.shape.get(), 0);
    if (unseen) {
      std::string bytes = shape_bytes(*body.shape);
      const auto [content, fresh] = by_content.try_emplace(bytes, table.shapes.size());
      if (fresh) table.shapes.push_back(std::move(bytes));
      object->second = content->second;
    }
    table.shape_of_body.push_back(object->second);
  }
  return table;
}

void check_frames(const std::string& name, const Recording& recording) {
  for (std::size_t f = 0; f < recording.frames.size(); ++f) {
    CONTACTCHECK_INVARIANT(recording.frames[f].size() == recording.bodies.size(),
                           "a recorded frame has the nodes of every body");
    for (std::size_t b = 0; b < recording.bodies.size(); ++b) {
      const std::vector<Vec3>& nodes = recording.frames[f][b];
      CONTACTCHECK_INVARIANT(nodes.size() == recording.bodies[b].shape->node_count(),
                             "a recorded body has a position for every node");
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (nodes[n].allFinite()) continue;
        throw InputError("cannot record \"" + name + "\": node " + std::to_string(n) +
                         " of body \"" + recording.bodies[b].name + "\" in frame " +
                         std::to_string(f) + " is not a finite position.");
      }
    }
  }
}

void check_recordable(const std::string& name, const Recording& recording) {
  const auto refuse = [&](const std::string& what) {
    throw InputError("cannot record \"" + name + "\": " + what + ".");
  };
  const std::string fault = scene_fault(recording.scene);
  if (!fault.empty()) refuse("the scene's name \"" + recording.scene + "\" " + fault);
  if (recording.bodies.empty()) refuse("the scene has no body");
  if (!std::isfinite(recording.time_step) || recording.time_step < 0.0) {
    refuse("the time step is " + std::to_string(recording.time_step) + " s");
  }
  for (const Body& body : recording.bodies) {
    const std::string body_fault = name_fault(body.name);
    if (!body_fault.empty()) refuse("the body name \"" + body.name + "\" " + body_fault);
  }
  check_frames(name, recording);
}

std::uint64_t version_of(const Recording& recording) {
  const bool welded = std::any_of(recording.bodies.begin(), recording.bodies.end(),
                                  [](const Body& body) { return !body.shape->welded.empty(); });
  return welded || !recording.levels.empty() ? kVersion : kPlainVersion;
}

std::string recording_content(const Recording& recording) {
  ByteWriter out;
  out.f64(recording.time_step);
  out.text(recording.scene);
  if (version_of(recording) == kVersion) {
    out.u64(recording.levels.size());
    for (const Level level : recording.levels) out.text(name_of(level));
  }
  const ShapeTable table = collect_shapes(recording.bodies);
  out.u64(table.shapes.size());
  for (const std::string& shape : table.shapes) {
    out.u64(fnv1a(shape));
    out.raw(shape);
  }
  out.u64(recording.bodies.size());
  for (std::size_t b = 0; b < recording.bodies.size(); ++b) {
    out.text(recording.bodies[b].name);
    out.u64(table.shape_of_body[b]);
  }
  out.u64(recording.frames.size());
  for (const auto& frame : recording.frames)
    for (std::size_t b = 0; b < frame.size(); ++b) {
      const BodyShape& shape = *recording.bodies[b].shape;
      if (shape.lattice || shape.given.dropped == 0)
        out.points(frame[b]);
      else
        out.points(shape.given.spread(frame[b]));
    }
  return out.bytes();
}

// --- reading ---

// Magic, version and size: afterwards the file is as long as it was written.
std::uint64_t check_header(ByteReader& in, std::uint64_t size) {
  if (size < kMagic.size() || in.take(kMagic.size(), "magic") != kMagic) {
    in.fail("not a recording: the first 8 bytes are not those of a .ccr file", 0);
  }
  if (size < kSmallestFile)
    in.fail("the file ends within its first " + std::to_string(kSmallestFile) + " bytes", size);
  const std::uint64_t version = in.u64("version");
  if (version != kPlainVersion && version != kVersion) {
    in.fail("version " + std::to_string(version) + " is not known, only versions " +
                std::to_string(kPlainVersion) + " and " + std::to_string(kVersion),
            8);
  }
  const std::uint64_t told = in.u64("file size");
  if (told != size) {
    in.fail("the file has " + std::to_string(size) + " bytes but was written with " +
                std::to_string(told),
            16);
  }
  return version;
}

// Afterwards the bytes are those that were written.
void check_hash(const ByteReader& in) {
  const std::size_t end = in.bytes().size() - kHashSize;
  ByteReader tail(in.bytes(), "");
  tail.take(end, "content");
  if (tail.u64("hash") != fnv1a(in.bytes().substr(0, end)))
    in.fail("the content does not have the hash it was written with", end);
}

std::string next_bytes(std::ifstream& in, std::uint64_t size) {
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  return bytes;
}

std::string file_bytes(const std::filesystem::path& file) {
  const std::string name = "recording \"" + file.string() + "\"";
  std::ifstream in = open_input_file(file, name);
  in.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(in.tellg());
  in.seekg(0);
  // Before the rest: a file that is no recording may be larger than memory.
  std::string bytes = next_bytes(in, std::min<std::uint64_t>(size, kHeaderSize));
  ByteReader header(bytes, file.string());
  if (in) {
    check_header(header, size);
    bytes += next_bytes(in, size - bytes.size());
  }
  if (!in) throw InputError(name + " cannot be read.");
  return bytes;
}

void read_lattice(ByteReader& in, BodyShape& shape) {
  Lattice lattice;
  for (std::vector<double>& lines : lattice.lines) {
    lines = in.doubles(in.count("lattice lines", 8), "lattice lines");
  }
  const std::size_t cells = in.count("lattice cells", 12);
  lattice.cells = in.u32_rows<3>(cells, "lattice cells");
  lattice.nodes = in.u32_rows<3>(in.count("lattice nodes", 12), "lattice nodes");
  lattice.cell_nodes = in.u32_rows<8>(cells, "nodes of the cells");
  Embedding& embedding = shape.embedding;
  embedding.home_cell = in.u32s(shape.mesh.vertices.size(), "home cells");
  embedding.local = in.points(shape.mesh.vertices.size(), "local coordinates");
  embedding.label_begin = in.u32s(shape.mesh.triangles.size() + 1, "label starts");
  embedding.label_cells = in.u32s(in.count("label cells", 4), "label cells");
  shape.lattice = std::move(lattice);
}

std::shared_ptr<const BodyShape> read_shape(ByteReader& in, std::size_t number,
                                            std::uint64_t version) {
  const std::uint64_t told_hash = in.u64("shape hash");
  const std::size_t begin = in.position();
  auto shape = std::make_shared<BodyShape>();
  shape->mesh.vertices = in.points(in.count("vertices", 24), "vertices");
  shape->mesh.triangles = in.u32_rows<3>(in.count("triangles", 12), "triangles");
  const std::uint64_t flags = in.u64("lattice flag");
  const std::uint64_t largest = version == kPlainVersion ? kHasLattice : kHasLattice | kIsWelded;
  if (flags > largest)
    in.fail("the lattice flag is not in 0 to " + std::to_string(largest), in.position() - 8);
  if ((flags & kHasLattice) != 0) read_lattice(in, *shape);
  if (fnv1a(in.bytes().substr(begin, in.position() - begin)) != told_hash) {
    in.fail("shape " + std::to_string(number) + " does not have the hash it is keyed by",
            begin - 8);
  }
  std::string fault = mesh_size_fault(shape->mesh.vertices.size(), shape->mesh.triangles.size());
  if (!fault.empty()) in.fail("shape " + std::to_string(number) + ": the mesh " + fault, begin);
  shape->topology = analyse_topology(shape->mesh);
  fault = shape_fault(*shape);
  if (!fault.empty()) in.fail("shape " + std::to_string(number) + ": " + fault, begin);
  drop_unused_vertices(*shape);
  if (shape->lattice) sort_by_cell(shape->lattice->cells.size(), shape->embedding);
  if ((flags & kIsWelded) != 0) return welded(*shape);
  return shape;
}

std::vector<std::shared_ptr<const BodyShape>> read_shapes(ByteReader& in, std::uint64_t version) {
  // The smallest shape: hash, two counts, flag; the count is bounded by that.
  std::vector<std::shared_ptr<const BodyShape>> shapes(in.count("shapes", 32));
  for (std::size_t s = 0; s < shapes.size(); ++s) shapes[s] = read_shape(in, s, version);
  return shapes;
}

std::vector<Level> read_levels(ByteReader& in) {
  std::vector<Level> levels(in.count("levels", 16));
  for (Level& level : levels) {
    const std::size_t where = in.position();
    const std::string name = in.text("level");
    const std::optional<Level> known = level_from_name(name);
    if (!known) in.fail("\"" + name + "\" is no level", where);
    level = *known;
  }
  return levels;
}

std::vector<Body> read_bodies(ByteReader& in,
                              const std::vector<std::shared_ptr<const BodyShape>>& shapes) {
  std::vector<Body> bodies(in.count("bodies", 16));
  if (bodies.empty()) in.fail("the recording has no body", in.position() - 8);
  for (Body& body : bodies) {
    const std::size_t where = in.position();
    body.name = in.text("body name");
    const std::string fault = name_fault(body.name);
    if (!fault.empty()) in.fail("the body name " + fault, where);
    const std::uint64_t shape = in.u64("shape number");
    if (shape >= shapes.size()) {
      in.fail("shape number " + std::to_string(shape) + " of " + std::to_string(shapes.size()),
              in.position() - 8);
    }
    body.shape = shapes[shape];
  }
  return bodies;
}

void read_frames(ByteReader& in, Recording& out) {
  std::size_t nodes = 0;
  const auto count = [](const BodyShape& shape) {
    return shape.lattice ? shape.node_count() : shape.given_vertex_count();
  };
  for (const Body& body : out.bodies) nodes += count(*body.shape);
  // No overflow: each shape's nodes were read from this file, and bodies are fewer than 2^32.
  out.frames.resize(in.count("frames", 24 * nodes));
  for (auto& frame : out.frames)
    for (const Body& body : out.bodies) {
      std::vector<Vec3> given = in.points(count(*body.shape), "nodes");
      frame.push_back(body.shape->lattice ? std::move(given)
                                          : body.shape->given.kept(std::move(given)));
    }
}

}  // namespace

std::string recording_bytes(const Recording& recording, const std::string& name) {
  check_recordable(name, recording);
  const std::string content = recording_content(recording);
  ByteWriter out;
  out.raw(kMagic);
  out.u64(version_of(recording));
  out.u64(kMagic.size() + 16 + content.size() + kHashSize);
  out.raw(content);
  out.u64(fnv1a(out.bytes()));
  return out.bytes();
}

void write_recording(const std::filesystem::path& file, const Recording& recording) {
  write_file_atomically(file, recording_bytes(recording, file.string()));
}

Recording read_recording_bytes(const std::string& bytes, const std::string& name) {
  ByteReader header(bytes, name);
  const std::uint64_t version = check_header(header, bytes.size());
  check_hash(ByteReader(bytes, name));
  ByteReader in(std::string_view(bytes).substr(0, bytes.size() - kHashSize), name);
  in.take(kHeaderSize, "header");
  Recording out;
  out.time_step = in.f64("time step");
  if (out.time_step < 0.0) in.fail("the time step is negative", in.position() - 8);
  const std::size_t where = in.position();
  out.scene = in.text("scene name");
  const std::string fault = scene_fault(out.scene);
  if (!fault.empty()) in.fail("the scene name " + fault, where);
  if (version == kVersion) out.levels = read_levels(in);
  out.bodies = read_bodies(in, read_shapes(in, version));
  read_frames(in, out);
  if (in.remaining() != 0)
    in.fail(std::to_string(in.remaining()) + " bytes too many after the last frame");
  return out;
}

Recording read_recording(const std::filesystem::path& file) {
  return read_recording_bytes(file_bytes(file), file.string());
}

}  // namespace contactcheck
