// Which of two numbers is simpler to read, and which simpler ones lie near a number.
#pragma once

#include <vector>

namespace contactcheck::reduce {

/// How much there is to read in a finite number. 0 is the simplest, then 1 and small whole numbers,
/// then numbers of few bits (a bit counts 2, a halving or doubling of the last one 1), then numbers
/// of few decimal digits (12, 4 a digit, 1 a place of the last one from the point); a minus sign
/// counts 1.
int complexity(double value);

/// Bits from the first to the last that is set: 0 for 0, 53 at most.
int significant_bits(double value);
/// Digits of the shortest decimal that reads back as the same double: 0 for 0, 17 at most.
int decimal_digits(double value);

/// `value` rounded to `bits` significant bits, ties to even. @pre bits from 1 to 53
double rounded_to_bits(double value, int bits);
/// `value` rounded to `digits` significant decimal digits. @pre digits from 1 to 17
double rounded_to_digits(double value, int digits);

/// Numbers simpler than `value`, the simplest first: 0, 1, -1, 2, -2, the whole numbers beside it,
/// its roundings to fewer bits (up and down) and to fewer decimal digits. All different.
std::vector<double> simpler_numbers(double value);

}  // namespace contactcheck::reduce
