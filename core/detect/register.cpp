#include "core/detect/families.h"
#include "core/detect/registry.h"

namespace contactcheck {

void register_core_detectors(DetectorCatalog& catalog) {
  register_ffd_detectors(catalog);
  register_triangle_detectors(catalog);
  register_bd_tree(catalog);
  register_lazy_detectors(catalog);
  register_step_detectors(catalog);
  register_impact_detectors(catalog);
}

}  // namespace contactcheck
