#include "reference/scene/amount.h"

#include <cmath>
#include <cstdlib>

namespace contactcheck::scene {
namespace {

// Reads "[constant][+|-]$[*factor]" or "constant" from left to right.
class AmountReader {
 public:
  explicit AmountReader(const char* text) : at_(text) {}

  std::optional<Amount> read() {
    Amount amount;
    const bool constant = *at_ != '$' && read_number(amount.constant);
    if (constant && *at_ == '\0') return amount;
    double sign = 1.0;
    if (*at_ == '+' || *at_ == '-') {
      sign = *at_++ == '-' ? -1.0 : 1.0;
    } else if (constant) {
      return std::nullopt;
    }
    if (*at_++ != '$') return std::nullopt;
    double factor = 1.0;
    if (*at_ == '*' && (++at_, !read_number(factor))) return std::nullopt;
    amount.factor = sign * factor;
    if (*at_ != '\0' || amount.factor == 0.0) return std::nullopt;
    return amount;
  }

 private:
  // A sign directly before $ belongs to it.
  bool read_number(double& out) {
    const char* const digits = *at_ == '-' || *at_ == '+' ? at_ + 1 : at_;
    if ((*digits < '0' || *digits > '9') && *digits != '.') return false;
    char* end = nullptr;
    out = std::strtod(at_, &end);
    if (end == at_ || !std::isfinite(out)) return false;
    at_ = end;
    return true;
  }

  const char* at_;
};

constexpr const char* kForms =
    "a finite number, or a text such as \"0x1p-52\", \"$\", \"1-$\" or \"0.5+$*2\", where $ is the "
    "parameter";

}  // namespace

std::optional<double> parse_double(const std::string& text) {
  const std::optional<Amount> amount = AmountReader(text.c_str()).read();
  if (!amount || amount->factor != 0.0 || text.find('\0') != std::string::npos) return std::nullopt;
  return amount->constant;
}

Amount parse_amount(const text::JsonField& field) {
  if (field.is(text::JsonValue::Kind::kNumber)) return {field.number(), 0.0};
  if (!field.is(text::JsonValue::Kind::kText)) field.refuse(kForms);
  const std::optional<Amount> amount = AmountReader(field.value().text.c_str()).read();
  if (!amount) field.refuse(kForms);
  return *amount;
}

AmountVector parse_amount_vector(const text::JsonField& field) {
  if (!field.is(text::JsonValue::Kind::kArray) || field.value().items.size() != 3)
    field.refuse("an array of three amounts");
  const std::vector<text::JsonField> parts = field.items();
  return {parse_amount(parts[0]), parse_amount(parts[1]), parse_amount(parts[2])};
}

}  // namespace contactcheck::scene
