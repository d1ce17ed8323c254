#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "core/model/vec3.h"

namespace limber::demos {

// What a field of a function takes.
enum class Kind {
  kNumber,
  kWhole,  // a whole number
  kFlag,   // true or false
  kText,
  kChoice,     // one of a few words
  kVector,     // vec or {x, y, z}
  kDirection,  // a vector that is not zero
  kColour,     // {red, green, blue}, each 0 to 1
  kWholes,     // three whole numbers
  kSteps,      // a number, or a list of {time, number}: changes with time
  kPath,       // a vector, or a list of {time, vector}
  kVectors,    // a list of vectors
  kNumbers,    // a list of numbers
  kFunction,
  kMaterial,
  kModel,
  kThing,  // an object or a body
  kBody,
  kRecord,   // a table with fields of its own
  kRecords,  // a list of them
};

// One named field: how it is checked, documented and completed by editors, all from here.
struct Field {
  struct Required {};
  struct Optional {};  // may be left out, and says nothing then
  using Default = std::variant<Required, Optional, double, bool, std::string, Vec3>;

  std::string name;
  Kind kind = Kind::kNumber;
  std::string unit;  // "m"; empty: none
  std::string meaning;
  Default otherwise = Required{};
  double least = -std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::max();
  bool least_allowed = true;
  std::vector<std::string> choices = {};
  std::vector<Field> fields = {};  // of a record

  Field optional() const;
  Field or_else(Default value) const;
  Field between(double low, double high) const;  // both allowed
  Field above(double low) const;                 // not allowed itself
  Field at_least(double low) const;
  Field up_to_infinity() const;  // math.huge is allowed
};

Field number(std::string name, std::string unit, std::string meaning);
Field field(std::string name, Kind kind, std::string unit, std::string meaning);
Field choice(std::string name, std::vector<std::string> words, std::string meaning);
Field record(std::string name, std::vector<Field> fields, std::string meaning);
Field records(std::string name, std::vector<Field> fields, std::string meaning);

// "three numbers in m, as in {1, 2, 3}": what to give, for messages.
std::string wanted(const Field& field);
// "0 to 10 m", "above 0 m"; empty: any.
std::string range_text(const Field& field);
// "0.5", "{0, 1, 0}": as a script writes it.
std::string default_text(const Field& field);

}  // namespace limber::demos
