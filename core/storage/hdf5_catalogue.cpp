#include "core/storage/hdf5_catalogue.h"

#include <limits>
#include <set>
#include <string_view>

#include "core/model/errors.h"
#include "core/storage/hdf5_object_header.h"

namespace limber {
namespace {

constexpr std::size_t kSuperblock = 48;  // bytes
constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";

using enum Hdf5MessageType;

class CatalogueReader {
 public:
  CatalogueReader(const OpenFile& file, std::uint64_t user_block)
      : file_(file), user_block_(user_block), room_(file.size()) {}

  Hdf5Catalogue read() {
    const std::uint64_t address = root_address();
    seen_.insert(address);
    const Hdf5ObjectHeader root(file_, user_block_, address);
    for (const Hdf5Message& message : root.messages())
      if (message.type == kAttribute) parse_attribute(message.body, catalogue_.attributes);
    read_group(root, "");
    return std::move(catalogue_);
  }

  const std::string& place() const { return place_; }

 private:
  // Section II.A, version 2.
  std::uint64_t root_address() const {
    std::vector<std::uint8_t> bytes(kSuperblock);
    bytes.resize(read_at(file_.descriptor(), user_block_, bytes.data(), kSuperblock, file_.path()));
    if (bytes.size() < kSuperblock) refuse_hdf5("holds no HDF5 where it should");
    Hdf5Cursor in(bytes);
    if (in.text(8) != kSignature) refuse_hdf5("holds no HDF5 where it should");
    in.expect(2, 1, "holds HDF5 with a superblock of another version than 2");
    in.expect(0x0808, 2, "holds HDF5 with addresses of another size than 8 bytes");
    in.number(1);  // whether somebody has it open
    in.expect(user_block_, 8, "holds HDF5 that begins somewhere else");
    in.expect(kHdf5Nowhere, 8, "holds HDF5 with extensions");
    in.expect(file_.size(), 8, "holds HDF5 that ends somewhere else");
    return in.number(8);
  }

  void read_group(const Hdf5ObjectHeader& group, const std::string& path) {
    refuse_dense(group);
    for (const Hdf5Message& message : group.messages()) {
      if (message.type != kLink) continue;
      const Hdf5Link link = parse_link(message.body);
      const std::string member = path.empty() ? link.name : path + "/" + link.name;
      read_object(link.address, member, path.empty());
      place_ = path;
    }
  }

  // Links in a heap of their own, Section IV.A.2.c.
  void refuse_dense(const Hdf5ObjectHeader& group) const {
    const Hdf5Message* info = group.find(kLinkInfo);
    if (info == nullptr) refuse_hdf5("is neither an array nor a group of arrays");
    Hdf5Cursor in(info->body);
    in.expect(0, 2, "keeps an order of its members");
    in.expect(kHdf5Nowhere, 8, "keeps its members in a heap");
  }

  void read_object(std::uint64_t address, const std::string& path, bool may_be_group) {
    place_ = path;
    if (!seen_.insert(address).second) refuse_hdf5("is there under two names");
    if (seen_.size() > kMostHdf5Objects) refuse_hdf5("is one array or group too many");
    const Hdf5ObjectHeader header(file_, user_block_, address);
    if (header.find(kLayout) != nullptr)
      read_array(header, path);
    else if (may_be_group)
      read_group(header, path);
    else
      refuse_hdf5("is neither an array nor a group of arrays");
  }

  void read_array(const Hdf5ObjectHeader& header, const std::string& path) {
    if (header.find(kExternalFiles) != nullptr) refuse_hdf5("is stored in another file");
    const Hdf5Message* space = header.find(kDataspace);
    const Hdf5Message* type = header.find(kDatatype);
    if (space == nullptr || type == nullptr) refuse_hdf5("has no type or no extents");
    const Hdf5Layout layout = parse_layout(header.find(kLayout)->body);
    if (header.find(kFilters) != nullptr) refuse_hdf5("is filtered");
    StoredArray array;
    array.type = parse_type(type->body);
    array.extents = parse_extents(space->body);
    array.bytes = claimed_bytes(array);
    array.offset = user_block_ + layout.address;
    if (array.bytes > 0) require_inside(layout, array.bytes);
    catalogue_.arrays.emplace(path, std::move(array));
  }

  // At most the size of the file for all of them together.
  std::uint64_t claimed_bytes(const StoredArray& array) {
    std::uint64_t bytes = bytes_of(array.type);
    for (std::uint64_t extent : array.extents) {
      if (extent > std::uint64_t(std::numeric_limits<std::int32_t>::max()) ||
          (extent > 0 && bytes > room_ / extent))
        refuse_hdf5("claims " + text_of_extents(array.extents) + ", more than a file of " +
                    std::to_string(file_.size()) + " bytes can hold");
      bytes *= extent;
    }
    if (bytes > room_) refuse_hdf5("is more than the file can hold");
    room_ -= bytes;
    return bytes;
  }

  void require_inside(const Hdf5Layout& layout, std::uint64_t bytes) const {
    const std::uint64_t room = file_.size() - user_block_;
    if (layout.bytes != bytes || layout.address > room || bytes > room - layout.address)
      refuse_hdf5("is not wholly in the file");
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
  } catch (const Hdf5Refusal& refusal) {
    const std::string where =
        file.path().string() + (reader.place().empty() ? "" : ": " + reader.place());
    throw InputError({where, refusal.what, "write it as docs/model_file.md says"});
  }
}

}  // namespace limber
