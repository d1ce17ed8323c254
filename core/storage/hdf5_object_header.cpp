#include "core/storage/hdf5_object_header.h"

#include <algorithm>
#include <cstring>

namespace limber {
namespace {

constexpr std::uint64_t kMostHeader = std::uint64_t{1} << 20;  // bytes of an object's header

// Flags of an object's header, section IV.A.1.b.
constexpr std::uint64_t kOrderKept = 0x0c;
constexpr std::uint64_t kPhases = 0x10;
constexpr std::uint64_t kTimes = 0x20;

}  // namespace

Hdf5ObjectHeader::Hdf5ObjectHeader(const OpenFile& file, std::uint64_t user_block,
                                   std::uint64_t address)
    : file_(file), user_block_(user_block) {
  const std::vector<std::uint8_t> start = read(address, 6);
  Hdf5Cursor in(start);
  if (in.text(4) != "OHDR") refuse_hdf5("has no header where one should be");
  in.expect(2, 1, "has a header of an unknown version");
  const std::uint64_t flags = in.number(1);
  if ((flags & kOrderKept) != 0) refuse_hdf5("keeps an order of its attributes");
  const std::uint64_t skipped = (flags & kTimes ? 16 : 0) + (flags & kPhases ? 4 : 0);
  const std::size_t width = std::size_t{1} << (flags & 0x03);
  const std::uint64_t size_at = address + 6 + skipped;
  add_piece(size_at + width, Hdf5Cursor(read(size_at, width)).number(width));
  for (std::size_t i = 0; i < messages_.size(); ++i)
    if (messages_[i].type == Hdf5MessageType::kContinuation) follow(messages_[i].body);
}

const Hdf5Message* Hdf5ObjectHeader::find(Hdf5MessageType type) const {
  const auto found = std::find_if(messages_.begin(), messages_.end(),
                                  [type](const Hdf5Message& m) { return m.type == type; });
  return found == messages_.end() ? nullptr : &*found;
}

std::vector<std::uint8_t> Hdf5ObjectHeader::read(std::uint64_t address, std::uint64_t size) const {
  const std::uint64_t room = file_.size() - user_block_;
  if (address > room || size > room - address || size > kMostHeader)
    refuse_hdf5("has a header that is not in the file");
  std::vector<std::uint8_t> bytes(size);
  if (read_at(file_.descriptor(), user_block_ + address, bytes.data(), size, file_.path()) != size)
    refuse_hdf5("has a header that is not in the file");
  return bytes;
}

// Every piece counts, so that pieces that continue each other in a circle end.
void Hdf5ObjectHeader::add_piece(std::uint64_t address, std::uint64_t size) {
  total_ += size;
  if (total_ > kMostHeader || pieces_.size() > kMostHdf5Objects)
    refuse_hdf5("has too long a header");
  pieces_.push_back(read(address, size));
  Hdf5Cursor in(pieces_.back());
  while (in.left() >= 4) {  // fewer are a gap
    Hdf5Message message;
    message.type = static_cast<Hdf5MessageType>(in.number(1));
    const std::uint64_t length = in.number(2);
    if ((in.number(1) & 0x02) != 0) refuse_hdf5("has a header that is partly elsewhere");
    message.body = in.take(length);
    messages_.push_back(message);
  }
}

void Hdf5ObjectHeader::follow(Hdf5Bytes continuation) {
  Hdf5Cursor in(continuation);
  const std::uint64_t address = in.number(8), size = in.number(8);
  const std::vector<std::uint8_t> start = read(address, 4);
  if (size < 8 || std::memcmp(start.data(), "OCHK", 4) != 0)
    refuse_hdf5("has a header that does not go on where it should");
  add_piece(address + 4, size - 8);  // without its signature and checksum
}

}  // namespace limber
