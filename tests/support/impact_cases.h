// Named queries of moving elements whose contacts are known.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/types/impact.h"

namespace contactcheck::test {

/// A closed interval of times, fractions of the step.
struct ContactTimes {
  double first, last;
};

struct ImpactCase {
  std::string name;
  ImpactQuery query;
  std::vector<ContactTimes> contacts;  ///< all of them, ascending
  /// The times are right within this: half a unit of the last digit, or 0 where doubles are exact.
  double error = 0;
};

/// Its name.
std::ostream& operator<<(std::ostream& out, const ImpactCase& impact);

/// Queries with several contacts, whole numbers: the largest numbers of contacts there can be.
std::vector<ImpactCase> repeated_contacts();

/// Each kind of contact and of degeneracy, and the smallest changes beside them.
std::vector<ImpactCase> impact_cases();

/// Whether the answer is right for these contacts; what is wrong with it, else empty.
std::string wrong_answer(const Impact& answer, const std::vector<ContactTimes>& contacts,
                         double error);

}  // namespace contactcheck::test
