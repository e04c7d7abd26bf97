// A detector of one's own in C++: it needs contactcheck::core and nothing else.
#pragma once

#include "core/core.h"

namespace example {

/// Adds the detector `cpp-sweep`: boxes of triangles swept along an axis, then core's exact test of
/// two triangles. All intersecting pairs of triangles, no others.
void register_sweep(contactcheck::DetectorCatalog& catalog);

/// Adds `cpp-boxes`, which answers queries of moving elements: boxes of the two elements over the
/// step, then core's exact test.
void register_boxes(contactcheck::DetectorCatalog& catalog);

}  // namespace example
