#include "reference/scene/amount.h"

#include <cmath>
#include <cstdlib>

namespace contactcheck::scene {
namespace {

// Reads "[constant][+|-]$[*factor]" or "constant" from left to right.
std::optional<Amount> read_amount(const char* at) {
  // A sign directly before $ belongs to it.
  const auto read_number = [&at](double& out) {
    const char* const digits = *at == '-' || *at == '+' ? at + 1 : at;
    if ((*digits < '0' || *digits > '9') && *digits != '.') return false;
    char* end = nullptr;
    out = std::strtod(at, &end);
    if (end == at || !std::isfinite(out)) return false;
    at = end;
    return true;
  };
  Amount amount;
  const bool constant = *at != '$' && read_number(amount.constant);
  if (constant && *at == '\0') return amount;
  double sign = 1.0;
  if (*at == '+' || *at == '-') {
    sign = *at++ == '-' ? -1.0 : 1.0;
  } else if (constant) {
    return std::nullopt;
  }
  if (*at++ != '$') return std::nullopt;
  double factor = 1.0;
  if (*at == '*' && (++at, !read_number(factor))) return std::nullopt;
  amount.factor = sign * factor;
  if (*at != '\0' || amount.factor == 0.0) return std::nullopt;
  return amount;
}

constexpr const char* kForms =
    "a finite number, or a text such as \"0x1p-52\", \"$\", \"1-$\" or \"0.5+$*2\", where $ is the "
    "parameter";

}  // namespace

std::optional<double> parse_double(const std::string& text) {
  const std::optional<Amount> amount = read_amount(text.c_str());
  if (!amount || amount->factor != 0.0 || text.find('\0') != std::string::npos) return std::nullopt;
  return amount->constant;
}

Amount parse_amount(const text::JsonField& field) {
  if (field.is(text::JsonValue::Kind::kNumber)) return {field.number(), 0.0};
  if (!field.is(text::JsonValue::Kind::kText)) field.refuse(kForms);
  const std::optional<Amount> amount = read_amount(field.value().text.c_str());
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
