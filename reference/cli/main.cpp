// contactcheck: the command line.
#include "reference/adapters/register.h"
#include "reference/cli/program.h"

int main(int argc, char** argv) {
  return contactcheck::cli::contactcheck_main(argc, argv,
                                              contactcheck::adapters::standard_catalog());
}
