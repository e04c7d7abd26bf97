#include "reference/certify/frame_text.h"

#include <fmt/format.h>

namespace contactcheck::certify {
namespace {

std::string pair_text(const BodyPair& pair) { return fmt::format("[{},{}]", pair.a, pair.b); }

std::string triangles_text(const ElementPair& t) {
  return fmt::format("{},{},{},{}", t.body_a, t.body_b, t.a, t.b);
}

std::string weights_text(const std::array<std::string, 3>& w) {
  return fmt::format(R"(["{}","{}","{}"])", w[0], w[1], w[2]);
}

// fmt writes the shortest decimal that reads back as the same double.
std::string number_text(const ExactNumber& number) {
  if (const auto* value = std::get_if<double>(&number)) return fmt::format("{}", *value);
  return '"' + std::get<std::string>(number) + '"';
}

std::string contact_text(const CertifiedContact& contact) {
  return fmt::format("[{},{},{}]", triangles_text(contact.triangles),
                     weights_text(contact.witness.p), weights_text(contact.witness.q));
}

std::string gap_text(const CertifiedGap& gap) {
  const auto& n = gap.plane.normal;
  return fmt::format("[{},[{},{},{},{}]]", triangles_text(gap.triangles), number_text(n[0]),
                     number_text(n[1]), number_text(n[2]), number_text(gap.plane.offset));
}

// One item a line.
template <typename Items, typename Text>
std::string list_text(const Items& items, const Text& text) {
  std::string out = "[";
  for (const auto& item : items) out += (out.size() > 1 ? ",\n  " : "\n  ") + text(item);
  return out + (items.empty() ? "]" : "\n ]");
}

}  // namespace

std::string frame_text(std::size_t frame, const std::vector<BodyPair>& bodies,
                       const FrameCertificate& certificate) {
  return fmt::format(
      "{{\"frame\": {},\n \"body_pairs\": {},\n \"contacts\": {},\n \"gaps\": {},\n"
      " \"decisions\": \"{}\"}}\n",
      frame, list_text(bodies, pair_text), list_text(certificate.contacts, contact_text),
      list_text(certificate.gaps, gap_text), certificate.decisions);
}

}  // namespace contactcheck::certify
