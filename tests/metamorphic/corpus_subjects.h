// The families of hard cases as subjects of relations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/metamorphic/subject.h"

namespace contactcheck::test {

/// A frame per value of the family's parameter.
std::shared_ptr<const Subject> subject_of_family(const std::string& id);

/// All families, made when first asked for.
const std::vector<std::shared_ptr<const Subject>>& corpus_subjects();

}  // namespace contactcheck::test
