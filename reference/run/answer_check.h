// An answer that names what is not there must not reach code that looks it up.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/detect/detector.h"
#include "reference/scene/scene.h"

namespace contactcheck {

/// Throws std::runtime_error for an answer that names a body or an element that is not there, or
/// that holds a depth or normal that is no number.
class AnswerCheck {
 public:
  AnswerCheck(const Scene& scene, std::size_t frame) : scene_(scene), frame_(frame) {}

  /// @pre the set is canonical: element pairs then imply their body pair
  void operator()(const ContactSet& contacts) const;

 private:
  const BodyShape& shape(std::uint32_t body) const { return *scene_.bodies[body].shape; }
  std::size_t cells_of(std::uint32_t body) const;
  std::size_t triangles_of(std::uint32_t body) const { return shape(body).mesh.triangles.size(); }
  void check_pair(std::uint32_t a, std::uint32_t b) const;
  void check_elements(const char* kind, const ElementPair& pair) const;
  void check_element(const char* kind, std::uint32_t body, std::uint32_t id,
                     std::size_t count) const;
  void check_vertex(const VertexInBody& vertex) const;
  void check_way_out(double depth, const Vec3& normal) const;
  void check_contacts(const ContactSet& contacts) const;
  [[noreturn]] void fail(const std::string& what) const;

  const Scene& scene_;
  std::size_t frame_;
};

/// Asks a question about the frame of the last update; the answer is canonical and names only what
/// is there. Reuses the capacity of `out`.
void ask(Detector& detector, Question question, const AnswerCheck& check, ContactSet& out);

}  // namespace contactcheck
