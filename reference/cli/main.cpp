// contactcheck: the command line.
#include "reference/adapters/register.h"
#include "reference/cli/program.h"

int main(int argc, char** argv) {
  return contactcheck::contactcheck_main(argc, argv, contactcheck::standard_catalog());
}
