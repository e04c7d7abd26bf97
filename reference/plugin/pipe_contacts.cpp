// The contacts behind an answer: lists of records of fixed size, one list after the other.
#include <cstring>

#include "core/types/check.h"
#include "reference/plugin/pipe_messages.h"

namespace contactcheck::plugin {
namespace {

constexpr std::size_t kWord = sizeof(std::uint32_t), kNumber = sizeof(double);

struct List {
  const char* key;
  std::size_t record;  ///< bytes
};

constexpr List kLists[] = {{"bodies", 2 * kWord},
                           {"triangles", 4 * kWord},
                           {"cells", 4 * kWord},
                           {"vertices", 3 * kWord},
                           {"near", 4 * kWord},
                           {"piece_contacts", 4 * kWord + 4 * kNumber},
                           {"vertex_contacts", 4 * kWord + 4 * kNumber}};

std::size_t count_of(const Reply& reply, const List& list) {
  if (!reply.root().has(list.key)) return 0;
  return reply.root().at(list.key).whole(0, kLargestAnswer / list.record);
}

/// Takes values off the front of what was read. @pre the sizes were checked
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t word() { return take<std::uint32_t>(); }
  double number() { return take<double>(); }
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  ElementPair elements() {
    const std::uint32_t body_a = word(), body_b = word(), a = word(), b = word();
    return {body_a, body_b, a, b};
  }
  VertexInBody vertex() {
    const std::uint32_t body = word(), in = word(), v = word();
    return {body, in, v};
  }

 private:
  template <typename T>
  T take() {
    T value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }
  std::string_view bytes_;
};

BodyPair read_bodies(Reader& in) {
  const std::uint32_t a = in.word(), b = in.word();
  return {a, b};
}

NearPair read_near(Reader& in) {
  const std::uint32_t body = in.word(), other = in.word(), vertex = in.word(), t = in.word();
  return {body, other, vertex, t};
}

PieceContact read_piece(Reader& in) {
  PieceContact contact;
  contact.pieces = in.elements();
  contact.depth = in.number();
  contact.normal = in.vector();
  return contact;
}

VertexContact read_vertex_contact(Reader& in) {
  VertexContact contact;
  contact.where = in.vertex();
  in.word();  // keeps the numbers behind it at a multiple of eight
  contact.depth = in.number();
  contact.normal = in.vector();
  return contact;
}

}  // namespace

void check_contact_counts(const Reply& reply) {
  std::size_t sum = 0;
  for (const List& list : kLists) sum += count_of(reply, list) * list.record;
  if (sum != reply.bytes())
    reply.root().fail("announces lists of " + std::to_string(sum) + " bytes together and says " +
                      std::to_string(reply.bytes()) + " in `bytes`");
}

void read_contacts(const Reply& reply, std::string_view bytes, ContactSet& out) {
  check_contact_counts(reply);
  CONTACTCHECK_INVARIANT(bytes.size() == reply.bytes(), "as many bytes as were announced");
  Reader in(bytes);
  std::size_t list = 0;
  const auto read = [&](auto& items, auto&& one) {
    const std::size_t count = count_of(reply, kLists[list++]);
    for (std::size_t i = 0; i < count; ++i) items.push_back(one(in));
  };
  read(out.bodies, read_bodies);
  read(out.triangles, [](Reader& r) { return r.elements(); });
  read(out.cells, [](Reader& r) { return r.elements(); });
  read(out.vertices, [](Reader& r) { return r.vertex(); });
  read(out.near, read_near);
  read(out.piece_contacts, read_piece);
  read(out.vertex_contacts, read_vertex_contact);
}

}  // namespace contactcheck::plugin
