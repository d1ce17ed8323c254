#include "core/storage/hdf5_catalogue.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <span>
#include <string_view>

#include "core/model/errors.h"

namespace limber {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t kNowhere = ~std::uint64_t{0};          // HDF5's undefined address
constexpr std::uint64_t kMostHeader = std::uint64_t{1} << 20;  // bytes of an object's header
constexpr std::size_t kMostObjects = 256;
constexpr std::size_t kSuperblock = 48;  // bytes
constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";

// Section IV.A.2 of the specification.
enum MessageType : std::uint8_t {
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

// Thrown within this file only: what is wrong, without where.
struct Refusal {
  std::string what;
};

[[noreturn]] void refuse(std::string what) { throw Refusal{std::move(what)}; }

std::string text_of(const std::vector<std::uint64_t>& extents) {
  std::string text;
  for (std::uint64_t extent : extents) text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text + " numbers";
}

// Takes little-endian numbers and pieces off the front; never reads beyond the end.
class Cursor {
 public:
  explicit Cursor(Bytes bytes) : left_(bytes) {}

  Bytes take(std::uint64_t count) {
    if (count > left_.size()) refuse("has a header that ends too early");
    const Bytes front = left_.first(count);
    left_ = left_.subspan(count);
    return front;
  }
  std::uint64_t number(std::size_t bytes) {
    std::uint64_t value = 0;
    const Bytes digits = take(bytes);
    for (std::size_t i = 0; i < bytes; ++i) value |= std::uint64_t{digits[i]} << (8 * i);
    return value;
  }
  std::string text(std::uint64_t bytes) {
    const Bytes t = take(bytes);
    return {t.begin(), t.end()};
  }
  // Takes what has to be there.
  void expect(std::uint64_t value, std::size_t bytes, const char* what) {
    if (number(bytes) != value) refuse(what);
  }
  std::size_t left() const { return left_.size(); }

 private:
  Bytes left_;
};

bool equal(Bytes a, std::initializer_list<std::uint8_t> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

// Section IV.A.2.d: class and version, bits, size, then for the classes what makes them these.
NumberType parse_type(Bytes bytes) {
  if (equal(bytes, {0x11, 0x20, 0x3f, 0, 8, 0, 0, 0, 0, 0, 64, 0, 52, 11, 0, 52, 0xff, 3, 0, 0}))
    return NumberType::kFloat64;
  if (equal(bytes, {0x10, 8, 0, 0, 4, 0, 0, 0, 0, 0, 32, 0})) return NumberType::kInt32;
  if (equal(bytes, {0x10, 8, 0, 0, 8, 0, 0, 0, 0, 0, 64, 0})) return NumberType::kInt64;
  if (equal(bytes, {0x10, 0, 0, 0, 1, 0, 0, 0, 0, 0, 8, 0})) return NumberType::kUint8;
  refuse("does not hold little-endian float64, int32, int64 or uint8");
}

// Section IV.A.2.b, version 2.
std::vector<std::uint64_t> parse_extents(Bytes bytes) {
  Cursor in(bytes);
  in.expect(2, 1, "has a dataspace of an unknown version");
  const std::uint64_t rank = in.number(1);
  const std::uint64_t flags = in.number(1);
  const std::uint64_t kind = in.number(1);
  if (rank > 2 || flags > 1 || kind != (rank == 0 ? 0u : 1u)) refuse("is not a list or a table");
  std::vector<std::uint64_t> extents(rank);
  for (std::uint64_t& extent : extents) extent = in.number(8);
  return extents;
}

// Section IV.A.2.i, version 3, contiguous. Gives address and bytes.
std::pair<std::uint64_t, std::uint64_t> parse_layout(Bytes bytes) {
  Cursor in(bytes);
  in.expect(3, 1, "has a layout of an unknown version");
  in.expect(1, 1, "is not stored contiguously");
  const std::uint64_t address = in.number(8);
  return {address, in.number(8)};
}

struct Link {
  std::string name;
  std::uint64_t address = kNowhere;
};

// Section IV.A.2.g: hard links only.
Link parse_link(Bytes bytes) {
  Cursor in(bytes);
  in.expect(1, 1, "has a link of an unknown version");
  const std::uint64_t flags = in.number(1);
  const bool typed = flags & 0x08, ordered = flags & 0x04, encoded = flags & 0x10;
  const std::uint64_t type = typed ? in.number(1) : 0;
  if (ordered) in.number(8);
  if (encoded) in.number(1);
  Link link;
  link.name = in.text(in.number(std::size_t{1} << (flags & 0x03)));
  if (type != 0) refuse("has with '" + link.name + "' a link to something elsewhere");
  if (link.name.empty() || link.name.find('/') != std::string::npos)
    refuse("has a member without a proper name");
  link.address = in.number(8);
  return link;
}

// Section IV.A.2.m, version 3, of the two kinds that the root has; others are left alone.
void parse_attribute(Bytes bytes, Hdf5Catalogue& catalogue) {
  Cursor in(bytes);
  in.expect(3, 1, "has an attribute of an unknown version");
  in.expect(0, 1, "has an attribute whose type is elsewhere");
  const std::uint64_t name_size = in.number(2), type_size = in.number(2), space_size = in.number(2);
  in.number(1);  // how the name is encoded
  std::string name = in.text(name_size);
  name.resize(std::min(name.find('\0'), name.size()));
  const Bytes type = in.take(type_size);
  if (!parse_extents(in.take(space_size)).empty()) return;
  if (equal(type, {0x10, 8, 0, 0, 4, 0, 0, 0, 0, 0, 32, 0})) {
    catalogue.numbers[name] = static_cast<std::int32_t>(in.number(4));
  } else if (type_size == 8 && type[0] == 0x13) {  // a string of fixed length
    std::string text = in.text(Cursor(type.subspan(4)).number(4));
    text.resize(std::min(text.find('\0'), text.size()));
    catalogue.texts[name] = text;
  }
}

// Flags of an object's header, section IV.A.1.b.
constexpr std::uint64_t kOrderKept = 0x0c;
constexpr std::uint64_t kPhases = 0x10;
constexpr std::uint64_t kTimes = 0x20;

struct Message {
  std::uint64_t type = kNil;
  Bytes body;
};

// The header of one object: its messages, from all of its pieces in the file.
class ObjectHeader {
 public:
  ObjectHeader(const OpenFile& file, std::uint64_t user_block, std::uint64_t address)
      : file_(file), user_block_(user_block) {
    const std::vector<std::uint8_t> start = read(address, 6);
    Cursor in(start);
    if (in.text(4) != "OHDR") refuse("has no header where one should be");
    in.expect(2, 1, "has a header of an unknown version");
    const std::uint64_t flags = in.number(1);
    if ((flags & kOrderKept) != 0) refuse("keeps an order of its attributes");
    const std::uint64_t skipped = (flags & kTimes ? 16 : 0) + (flags & kPhases ? 4 : 0);
    const std::size_t width = std::size_t{1} << (flags & 0x03);
    const std::uint64_t size_at = address + 6 + skipped;
    add_piece(size_at + width, Cursor(read(size_at, width)).number(width));
    for (std::size_t i = 0; i < messages_.size(); ++i)
      if (messages_[i].type == kContinuation) follow(messages_[i].body);
  }

  const std::vector<Message>& messages() const { return messages_; }
  const Message* find(std::uint64_t type) const {
    const auto found = std::find_if(messages_.begin(), messages_.end(),
                                    [type](const Message& m) { return m.type == type; });
    return found == messages_.end() ? nullptr : &*found;
  }

 private:
  std::vector<std::uint8_t> read(std::uint64_t address, std::uint64_t size) const {
    const std::uint64_t room = file_.size() - user_block_;
    if (address > room || size > room - address || size > kMostHeader)
      refuse("has a header that is not in the file");
    std::vector<std::uint8_t> bytes(size);
    if (read_at(file_.descriptor(), user_block_ + address, bytes.data(), size, file_.path()) !=
        size)
      refuse("has a header that is not in the file");
    return bytes;
  }

  // Every piece counts, so that pieces that continue each other in a circle end.
  void add_piece(std::uint64_t address, std::uint64_t size) {
    total_ += size;
    if (total_ > kMostHeader || pieces_.size() > kMostObjects) refuse("has too long a header");
    pieces_.push_back(read(address, size));
    Cursor in(pieces_.back());
    while (in.left() >= 4) {  // fewer are a gap
      Message message;
      message.type = in.number(1);
      const std::uint64_t length = in.number(2);
      if ((in.number(1) & 0x02) != 0) refuse("has a header that is partly elsewhere");
      message.body = in.take(length);
      messages_.push_back(message);
    }
  }

  void follow(Bytes body) {
    Cursor in(body);
    const std::uint64_t address = in.number(8), size = in.number(8);
    const std::vector<std::uint8_t> start = read(address, 4);
    if (size < 8 || std::memcmp(start.data(), "OCHK", 4) != 0)
      refuse("has a header that does not go on where it should");
    add_piece(address + 4, size - 8);  // without its signature and checksum
  }

  const OpenFile& file_;
  std::uint64_t user_block_;
  std::uint64_t total_ = 0;
  std::vector<std::vector<std::uint8_t>> pieces_;
  std::vector<Message> messages_;
};

class CatalogueReader {
 public:
  CatalogueReader(const OpenFile& file, std::uint64_t user_block)
      : file_(file), user_block_(user_block), room_(file.size()) {}

  Hdf5Catalogue read() {
    const std::uint64_t address = root_address();
    seen_.insert(address);
    const ObjectHeader root(file_, user_block_, address);
    for (const Message& message : root.messages())
      if (message.type == kAttribute) parse_attribute(message.body, catalogue_);
    read_group(root, "");
    return std::move(catalogue_);
  }

  const std::string& place() const { return place_; }

 private:
  // Section II.A, version 2.
  std::uint64_t root_address() const {
    std::vector<std::uint8_t> bytes(kSuperblock);
    bytes.resize(read_at(file_.descriptor(), user_block_, bytes.data(), kSuperblock, file_.path()));
    if (bytes.size() < kSuperblock) refuse("holds no HDF5 where it should");
    Cursor in(bytes);
    if (in.text(8) != kSignature) refuse("holds no HDF5 where it should");
    in.expect(2, 1, "holds HDF5 with a superblock of another version than 2");
    in.expect(0x0808, 2, "holds HDF5 with addresses of another size than 8 bytes");
    in.number(1);  // whether somebody has it open
    in.expect(user_block_, 8, "holds HDF5 that begins somewhere else");
    in.expect(kNowhere, 8, "holds HDF5 with extensions");
    in.expect(file_.size(), 8, "holds HDF5 that ends somewhere else");
    return in.number(8);
  }

  void read_group(const ObjectHeader& group, const std::string& path) {
    refuse_dense(group);
    for (const Message& message : group.messages()) {
      if (message.type != kLink) continue;
      const Link link = parse_link(message.body);
      const std::string member = path.empty() ? link.name : path + "/" + link.name;
      read_object(link.address, member, path.empty());
      place_ = path;
    }
  }

  // Links in a heap of their own, Section IV.A.2.c.
  void refuse_dense(const ObjectHeader& group) const {
    const Message* info = group.find(kLinkInfo);
    if (info == nullptr) refuse("is neither an array nor a group of arrays");
    Cursor in(info->body);
    in.expect(0, 2, "keeps an order of its members");
    in.expect(kNowhere, 8, "keeps its members in a heap");
  }

  void read_object(std::uint64_t address, const std::string& path, bool may_be_group) {
    place_ = path;
    if (!seen_.insert(address).second) refuse("is there under two names");
    if (seen_.size() > kMostObjects) refuse("is one array or group too many");
    const ObjectHeader header(file_, user_block_, address);
    if (header.find(kLayout) != nullptr)
      read_array(header, path);
    else if (may_be_group)
      read_group(header, path);
    else
      refuse("is neither an array nor a group of arrays");
  }

  void read_array(const ObjectHeader& header, const std::string& path) {
    if (header.find(kExternalFiles) != nullptr) refuse("is stored in another file");
    const Message* space = header.find(kDataspace);
    const Message* type = header.find(kDatatype);
    if (space == nullptr || type == nullptr) refuse("has no type or no extents");
    const auto [address, bytes] = parse_layout(header.find(kLayout)->body);
    if (header.find(kFilters) != nullptr) refuse("is filtered");
    StoredArray array;
    array.type = parse_type(type->body);
    array.extents = parse_extents(space->body);
    array.bytes = claimed_bytes(array);
    array.offset = user_block_ + address;
    if (array.bytes > 0) require_inside(array, address, bytes);
    catalogue_.arrays.emplace(path, std::move(array));
  }

  // At most the size of the file for all of them together.
  std::uint64_t claimed_bytes(const StoredArray& array) {
    std::uint64_t bytes = bytes_of(array.type);
    for (std::uint64_t extent : array.extents) {
      if (extent > std::uint64_t(std::numeric_limits<std::int32_t>::max()) ||
          (extent > 0 && bytes > room_ / extent))
        refuse("claims " + text_of(array.extents) + ", more than a file of " +
               std::to_string(file_.size()) + " bytes can hold");
      bytes *= extent;
    }
    if (bytes > room_) refuse("is more than the file can hold");
    room_ -= bytes;
    return bytes;
  }

  void require_inside(const StoredArray& array, std::uint64_t address, std::uint64_t bytes) const {
    const std::uint64_t room = file_.size() - user_block_;
    if (bytes != array.bytes || address > room || bytes > room - address)
      refuse("is not wholly in the file");
  }

  const OpenFile& file_;
  std::uint64_t user_block_;
  std::uint64_t room_;  // bytes that arrays may yet claim
  std::set<std::uint64_t> seen_;
  std::string place_;  // what is being read, for messages
  Hdf5Catalogue catalogue_;
};

}  // namespace

Hdf5Catalogue read_catalogue(const OpenFile& file, std::uint64_t user_block) {
  CatalogueReader reader(file, user_block);
  try {
    return reader.read();
  } catch (const Refusal& refusal) {
    const std::string where =
        file.path().string() + (reader.place().empty() ? "" : ": " + reader.place());
    throw InputError({where, refusal.what, "write it as docs/model_file.md says"});
  }
}

}  // namespace limber
