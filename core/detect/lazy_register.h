#pragma once

#include "core/detect/registry.h"

namespace contactcheck {

/// ffd-lazy and full-refit.
void register_lazy_detectors(DetectorCatalog& catalog);

}  // namespace contactcheck
