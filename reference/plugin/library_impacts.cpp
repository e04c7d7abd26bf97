#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/types/check.h"
#include "reference/plugin/library_object.h"
#include "reference/plugin/plugin_library.h"

namespace contactcheck::plugin {
namespace {

void copy(const std::array<Vec3, 4>& points, double (&out)[12]) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      out[3 * i + axis] = points[i][static_cast<int>(axis)];
}

std::uint32_t bit_of(ImpactKind kind) {
  return kind == ImpactKind::vertex_triangle ? CONTACTCHECK_VERTEX_FACE : CONTACTCHECK_EDGE_EDGE;
}

class LibraryImpacts final : public ImpactDetector {
 public:
  LibraryImpacts(const PluginLibrary& library, const Options& options) : object_(library, options) {
    contactcheck_impact_semantics said = {};
    object_.call("declare_impacts", object_.table().declare_impacts, &said);
    try {
      claims_.kinds = values_of(said.kinds, kHeaderKinds, "kinds of queries");
      claims_.precision = value_of(said.precision, kHeaderPrecisions, "precision");
      claims_.tolerance = {said.tolerance, said.tolerance_of_start};
      if (claims_.kinds.empty()) return;  // it answers steps alone
      if (object_.table().impact == nullptr)
        throw InputError("declares kinds of queries and has no function impact");
      const std::string fault = claims_fault(claims_);
      if (!fault.empty()) throw InputError("declares what does not fit together: " + fault);
    } catch (const InputError& e) {
      throw InputError(object_.name() + " " + e.what());
    }
  }

  const ImpactClaims& claims() const { return claims_; }

  ImpactTolerance tolerance() const override { return claims_.tolerance; }

  ReportedImpact query(const ImpactQuery& query) override {
    contactcheck_impact_query asked = {bit_of(query.kind), 0, {}, {}};
    copy(query.start, asked.start);
    copy(query.end, asked.end);
    contactcheck_impact answer = {};
    object_.call("impact", object_.table().impact, &asked, &answer);
    ReportedImpact out;
    out.contact = answer.contact != 0;
    if ((answer.has & CONTACTCHECK_HAS_TIME) != 0) out.time = answer.time;
    if ((answer.has & CONTACTCHECK_HAS_TOLERANCE) != 0) out.tolerance = answer.tolerance;
    return out;
  }

 private:
  LibraryObject object_;
  ImpactClaims claims_;
};

}  // namespace

std::unique_ptr<ImpactDetector> make_library_impact_detector(const PluginLibrary& library,
                                                             const Options& options,
                                                             const ImpactClaims& declared) {
  auto detector = std::make_unique<LibraryImpacts>(library, options);
  require_same_claims(library.name(), declared, detector->claims());
  return detector;
}

std::optional<ImpactClaims> impact_claims_of(const PluginLibrary& library, const Options& options) {
  if (library.table().declare_impacts == nullptr) return std::nullopt;
  const ImpactClaims claims = LibraryImpacts(library, options).claims();
  if (claims.kinds.empty()) return std::nullopt;
  return claims;
}

}  // namespace contactcheck::plugin
