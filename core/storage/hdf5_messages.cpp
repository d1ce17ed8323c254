#include "core/storage/hdf5_messages.h"

#include <algorithm>
#include <iterator>

namespace limber {
namespace {

// Section IV.A.2.d: class and version, bits, size, then for the classes what makes them these.
constexpr std::uint8_t kFloat64[] = {0x11, 0x20, 0x3f, 0,  8, 0,  0,    0, 0, 0,
                                     64,   0,    52,   11, 0, 52, 0xff, 3, 0, 0};
constexpr std::uint8_t kInt32[] = {0x10, 8, 0, 0, 4, 0, 0, 0, 0, 0, 32, 0};
constexpr std::uint8_t kInt64[] = {0x10, 8, 0, 0, 8, 0, 0, 0, 0, 0, 64, 0};
constexpr std::uint8_t kUint8[] = {0x10, 0, 0, 0, 1, 0, 0, 0, 0, 0, 8, 0};

bool equal(Hdf5Bytes a, Hdf5Bytes b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }

}  // namespace

NumberType parse_type(Hdf5Bytes bytes) {
  if (equal(bytes, kFloat64)) return NumberType::kFloat64;
  if (equal(bytes, kInt32)) return NumberType::kInt32;
  if (equal(bytes, kInt64)) return NumberType::kInt64;
  if (equal(bytes, kUint8)) return NumberType::kUint8;
  refuse_hdf5("does not hold little-endian float64, int32, int64 or uint8");
}

// Section IV.A.2.b, version 2.
std::vector<std::uint64_t> parse_extents(Hdf5Bytes bytes) {
  Hdf5Cursor in(bytes);
  in.expect(2, 1, "has a dataspace of an unknown version");
  const std::uint64_t rank = in.number(1);
  const std::uint64_t flags = in.number(1);
  const std::uint64_t kind = in.number(1);
  if (rank > 2 || flags > 1 || kind != (rank == 0 ? 0u : 1u))
    refuse_hdf5("is not a list or a table");
  std::vector<std::uint64_t> extents(rank);
  for (std::uint64_t& extent : extents) extent = in.number(8);
  return extents;
}

// Section IV.A.2.i, version 3.
Hdf5Layout parse_layout(Hdf5Bytes bytes) {
  Hdf5Cursor in(bytes);
  in.expect(3, 1, "has a layout of an unknown version");
  in.expect(1, 1, "is not stored contiguously");
  Hdf5Layout layout;
  layout.address = in.number(8);
  layout.bytes = in.number(8);
  return layout;
}

// Section IV.A.2.g: hard links only.
Hdf5Link parse_link(Hdf5Bytes bytes) {
  Hdf5Cursor in(bytes);
  in.expect(1, 1, "has a link of an unknown version");
  const std::uint64_t flags = in.number(1);
  const bool typed = flags & 0x08, ordered = flags & 0x04, encoded = flags & 0x10;
  const std::uint64_t type = typed ? in.number(1) : 0;
  if (ordered) in.number(8);
  if (encoded) in.number(1);
  Hdf5Link link;
  link.name = in.text(in.number(std::size_t{1} << (flags & 0x03)));
  if (type != 0) refuse_hdf5("has with '" + link.name + "' a link to something elsewhere");
  if (link.name.empty() || link.name.find('/') != std::string::npos)
    refuse_hdf5("has a member without a proper name");
  link.address = in.number(8);
  return link;
}

// Section IV.A.2.m, version 3.
void parse_attribute(Hdf5Bytes bytes, Hdf5Attributes& attributes) {
  Hdf5Cursor in(bytes);
  in.expect(3, 1, "has an attribute of an unknown version");
  in.expect(0, 1, "has an attribute whose type is elsewhere");
  const std::uint64_t name_size = in.number(2), type_size = in.number(2), space_size = in.number(2);
  in.number(1);  // how the name is encoded
  std::string name = in.text(name_size);
  name.resize(std::min(name.find('\0'), name.size()));
  const Hdf5Bytes type = in.take(type_size);
  if (!parse_extents(in.take(space_size)).empty()) return;
  if (equal(type, kInt32)) {
    attributes.numbers[name] = static_cast<std::int32_t>(in.number(4));
  } else if (type_size == 8 && type[0] == 0x13) {  // a string of fixed length
    std::string text = in.text(Hdf5Cursor(type.subspan(4)).number(4));
    text.resize(std::min(text.find('\0'), text.size()));
    attributes.texts[name] = text;
  }
}

}  // namespace limber
