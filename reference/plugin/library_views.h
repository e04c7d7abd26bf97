// What crosses the C interface, in the form of contactcheck_plugin.h and in our own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/semantics.h"
#include "reference/plugin/contactcheck_plugin.h"

namespace contactcheck::plugin {

/// Numbers of points, one after the other.
const double* numbers(std::span<const Vec3> points);

/// A body as a plug-in sees it. Points into the body's shape, which it keeps.
class BodyView {
 public:
  explicit BodyView(const Body& from);
  BodyView(const BodyView&) = delete;
  BodyView& operator=(const BodyView&) = delete;

  const contactcheck_body& body() const { return body_; }

 private:
  void add_lattice(const Lattice& from, const Embedding& embedding);

  Body from_;
  std::vector<Vec3> rest_nodes_;
  contactcheck_lattice lattice_ = {};
  contactcheck_body body_ = {};
};

/// As they are before a plug-in says anything.
contactcheck_semantics default_semantics();
/// @throws InputError for what does not exist or does not fit together
Semantics semantics_of(const contactcheck_semantics& from);

std::uint32_t number_of(Question question);

/// Functions that append to `out`.
contactcheck_answer answer_into(ContactSet& out);

}  // namespace contactcheck::plugin
