#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/storage/array_values.h"
#include "core/storage/hdf5_cursor.h"

namespace limber {

// The messages that an object's header consists of, in the HDF5 file format specification 3.0. Only
// as much of them as hdf5_catalogue.h takes; all throw Hdf5Refusal at anything else.

// Section IV.A.2 of the specification.
enum class Hdf5MessageType : std::uint8_t {
  kNil = 0x00,
  kDataspace = 0x01,
  kLinkInfo = 0x02,
  kDatatype = 0x03,
  kFillValue = 0x05,
  kLink = 0x06,
  kExternalFiles = 0x07,
  kLayout = 0x08,
  kGroupInfo = 0x0a,
  kFilters = 0x0b,
  kAttribute = 0x0c,
  kContinuation = 0x10,
  kAttributeInfo = 0x15,
};

// The datatype message: one of ours.
NumberType parse_type(Hdf5Bytes bytes);

// The dataspace message. At most two extents; none for a single number.
std::vector<std::uint64_t> parse_extents(Hdf5Bytes bytes);

// Where a contiguous array lies.
struct Hdf5Layout {
  std::uint64_t address = kHdf5Nowhere;
  std::uint64_t bytes = 0;
};
Hdf5Layout parse_layout(Hdf5Bytes bytes);

struct Hdf5Link {
  std::string name;
  std::uint64_t address = kHdf5Nowhere;
};
Hdf5Link parse_link(Hdf5Bytes bytes);

// Attributes by their names.
struct Hdf5Attributes {
  std::map<std::string, std::string> texts;
  std::map<std::string, std::int32_t> numbers;
};

// Adds an attribute if it is a text of fixed length or an int32, the two kinds that the root has;
// others are left alone.
void parse_attribute(Hdf5Bytes bytes, Hdf5Attributes& attributes);

}  // namespace limber
