// contactcheck with two detectors more. Its workers are this program again: main is this call
// alone.
#include "reference/reference.h"
#include "sweep_detector.h"

int main(int argc, char** argv) {
  contactcheck::DetectorCatalog catalog = contactcheck::standard_catalog();
  example::register_sweep(catalog);
  example::register_boxes(catalog);
  return contactcheck::contactcheck_main(argc, argv, catalog);
}
