#include "core/detect/bd_tree_register.h"
#include "core/detect/ffd_register.h"
#include "core/detect/lazy_register.h"
#include "core/detect/registry.h"
#include "core/detect/triangle_register.h"

namespace contactcheck {

void register_core_detectors(DetectorCatalog& catalog) {
  register_ffd_detectors(catalog);
  register_triangle_detectors(catalog);
  register_bd_tree(catalog);
  register_lazy_detectors(catalog);
}

}  // namespace contactcheck
