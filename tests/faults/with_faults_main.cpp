// contactcheck with detectors beside its own that strike at the process they run in or err.
#include "reference/adapters/register.h"
#include "reference/cli/program.h"
#include "tests/faults/geometry_faults.h"
#include "tests/faults/process_faults.h"

int main(int argc, char** argv) {
  contactcheck::DetectorCatalog catalog = contactcheck::adapters::standard_catalog();
  contactcheck::test::register_process_faults(catalog);
  contactcheck::test::register_geometry_faults(catalog);
  return contactcheck::cli::contactcheck_main(argc, argv, catalog);
}
