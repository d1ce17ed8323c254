#include "demos/scripting/field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace limber::demos {
namespace {

constexpr double kAny = std::numeric_limits<double>::max();

std::string in_unit(const Field& f) { return f.unit.empty() ? "" : " in " + f.unit; }
std::string with_unit(const Field& f) { return f.unit.empty() ? "" : " " + f.unit; }

}  // namespace

Field Field::optional() const { return or_else(Optional{}); }

Field Field::or_else(Default value) const {
  Field changed = *this;
  changed.otherwise = std::move(value);
  return changed;
}

Field Field::between(double low, double high) const {
  Field changed = *this;
  changed.least = low;
  changed.most = high;
  return changed;
}

Field Field::above(double low) const {
  Field changed = at_least(low);
  changed.least_allowed = false;
  return changed;
}

Field Field::at_least(double low) const {
  Field changed = *this;
  changed.least = low;
  return changed;
}

Field Field::up_to_infinity() const {
  Field changed = *this;
  changed.most = std::numeric_limits<double>::infinity();
  return changed;
}

Field number(std::string name, std::string unit, std::string meaning) {
  return field(std::move(name), Kind::kNumber, std::move(unit), std::move(meaning));
}

Field field(std::string name, Kind kind, std::string unit, std::string meaning) {
  Field made;
  made.name = std::move(name);
  made.kind = kind;
  made.unit = std::move(unit);
  made.meaning = std::move(meaning);
  return made;
}

Field choice(std::string name, std::vector<std::string> words, std::string meaning) {
  Field made = field(std::move(name), Kind::kChoice, "", std::move(meaning));
  made.choices = std::move(words);
  return made;
}

Field record(std::string name, std::vector<Field> fields, std::string meaning) {
  Field made = field(std::move(name), Kind::kRecord, "", std::move(meaning));
  made.fields = std::move(fields);
  return made;
}

Field records(std::string name, std::vector<Field> fields, std::string meaning) {
  Field made = record(std::move(name), std::move(fields), std::move(meaning));
  made.kind = Kind::kRecords;
  return made;
}

std::string wanted(const Field& f) {
  switch (f.kind) {
    case Kind::kNumber:
      return "a number" + in_unit(f);
    case Kind::kWhole:
      return "a whole number" + in_unit(f);
    case Kind::kFlag:
      return "true or false";
    case Kind::kText:
      return "a text";
    case Kind::kChoice:
      return fmt::format("\"{}\"", fmt::join(f.choices, "\" or \""));
    case Kind::kVector:
      return "three numbers" + in_unit(f) + ", as in {1, 2, 3}";
    case Kind::kDirection:
      return "a direction, as in {0, 1, 0}";
    case Kind::kColour:
      return "a colour of three numbers from 0 to 1, as in {0.8, 0.2, 0.1}";
    case Kind::kWholes:
      return "three whole numbers, as in {4, 4, 4}";
    case Kind::kSteps:
      return "a number" + in_unit(f) + ", or a list of {time, number}";
    case Kind::kPath:
      return "three numbers" + in_unit(f) + ", or a list of {time, {x, y, z}}";
    case Kind::kVectors:
      return "a list of vectors" + in_unit(f);
    case Kind::kNumbers:
      return "a list of numbers" + in_unit(f);
    case Kind::kFunction:
      return "a function";
    case Kind::kMaterial:
      return "a material, or the name of one";
    case Kind::kModel:
      return "a model, as shape.box{} makes one";
    case Kind::kThing:
      return "an object that was spawned, or a body";
    case Kind::kBody:
      return "a body, as rigid.box{} makes one";
    case Kind::kRecord:
      return "a table with named fields";
    case Kind::kRecords:
      return "a list of tables with named fields";
  }
  return "";
}

std::string range_text(const Field& f) {
  const bool low = f.least > -kAny, high = f.most < kAny;
  if (low && high) return fmt::format("{:g} to {:g}{}", f.least, f.most, with_unit(f));
  if (low) {
    return fmt::format("{} {:g}{}", f.least_allowed ? "at least" : "above", f.least, with_unit(f));
  }
  if (high) return fmt::format("at most {:g}{}", f.most, with_unit(f));
  return "";
}

std::string default_text(const Field& f) {
  struct Text {
    std::string operator()(Field::Required) const { return ""; }
    std::string operator()(Field::Optional) const { return ""; }
    std::string operator()(double value) const {
      return value > kAny ? "math.huge" : fmt::format("{:g}", value);
    }
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(const std::string& value) const { return '"' + value + '"'; }
    std::string operator()(const Vec3& v) const {
      return fmt::format("{{{:g}, {:g}, {:g}}}", v.x(), v.y(), v.z());
    }
  };
  return std::visit(Text{}, f.otherwise);
}

}  // namespace limber::demos
