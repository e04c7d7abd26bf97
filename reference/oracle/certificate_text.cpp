#include "reference/oracle/certificate_text.h"

#include <fmt/format.h>

#include <cmath>

namespace contactcheck::oracle::certify {
namespace {

// fmt writes the shortest decimal that reads back as the same double.
std::string number_text(const ExactNumber& number) {
  if (const auto* value = std::get_if<double>(&number)) return fmt::format("{}", *value);
  return '"' + std::get<std::string>(number) + '"';
}

std::string number_text(const mpq_class& value) {
  const double rounded = value.get_d();
  if (std::isfinite(rounded) && mpq_class(rounded) == value) return fmt::format("{}", rounded);
  return '"' + value.get_str(16) + '"';
}

std::string weights_text(const std::array<std::string, 3>& w) {
  return fmt::format(R"(["{}","{}","{}"])", w[0], w[1], w[2]);
}

/// A number, or [x, y] for x + y times the square root that the line names.
std::string surd_text(const Surd& surd, bool rational) {
  return rational ? number_text(surd.x)
                  : fmt::format("[{},{}]", number_text(surd.x), number_text(surd.y));
}

std::string piece_text(const ApartPiece& piece) {
  const std::string end = number_text(piece.end);
  if (const auto* side = std::get_if<Side>(&piece.reason))
    return fmt::format(R"([{},"side",{},{},{}])", end, side->axis, side->from, side->to);
  if (const auto* direction = std::get_if<Direction>(&piece.reason)) {
    const auto& [x, y, z] = direction->along;
    return fmt::format(R"([{},"direction",{},{},{}])", end, number_text(mpq_class(x)),
                       number_text(mpq_class(y)), number_text(mpq_class(z)));
  }
  return fmt::format(R"([{},"volume"])", end);
}

std::string meeting_text(const Meeting& meeting) {
  const bool rational = meeting.time.root == 0;
  std::string weights;
  for (const Surd& weight : meeting.weights)
    weights += (weights.empty() ? "" : ",") + surd_text(weight, rational);
  const std::string root = rational ? "" : ',' + number_text(mpq_class(meeting.time.root));
  return fmt::format("[{},[{}]{}]", surd_text(meeting.time, rational), weights, root);
}

}  // namespace

std::string witness_text(const Witness& witness) {
  return weights_text(witness.p) + ',' + weights_text(witness.q);
}

std::string plane_text(const Plane& plane) {
  const auto& n = plane.normal;
  return fmt::format("[{},{},{},{}]", number_text(n[0]), number_text(n[1]), number_text(n[2]),
                     number_text(plane.offset));
}

std::string impact_text(const ImpactCertificate& certificate) {
  std::string text;
  for (const ApartPiece& piece : certificate.apart)
    text += (text.empty() ? "" : ",") + piece_text(piece);
  text = R"({"apart":[)" + text + ']';
  if (const auto* crossing = std::get_if<Crossing>(&certificate.contact))
    text += fmt::format(R"(,"crosses":[{},{},{}])", number_text(crossing->start),
                        number_text(crossing->end), crossing->axis);
  if (const auto* meeting = std::get_if<Meeting>(&certificate.contact))
    text += R"(,"meets":)" + meeting_text(*meeting);
  return text + '}';
}

}  // namespace contactcheck::oracle::certify
