#pragma once

#include <cstdint>
#include <vector>

#include "core/storage/hdf5_messages.h"
#include "core/storage/open_file.h"

namespace limber {

// Arrays and groups in a file, and pieces of one's header: more is no model.
inline constexpr std::size_t kMostHdf5Objects = 256;

struct Hdf5Message {
  Hdf5MessageType type = Hdf5MessageType::kNil;
  Hdf5Bytes body;
};

// The header of one object (specification, section IV.A.1.b): its messages, from all of its pieces
// in the file. Throws Hdf5Refusal.
class Hdf5ObjectHeader {
 public:
  // The file has to live as long as this.
  Hdf5ObjectHeader(const OpenFile& file, std::uint64_t user_block, std::uint64_t address);
  Hdf5ObjectHeader(const Hdf5ObjectHeader&) = delete;  // the messages are views of its pieces
  Hdf5ObjectHeader& operator=(const Hdf5ObjectHeader&) = delete;

  const std::vector<Hdf5Message>& messages() const { return messages_; }
  const Hdf5Message* find(Hdf5MessageType type) const;  // the first; null for none

 private:
  std::vector<std::uint8_t> read(std::uint64_t address, std::uint64_t size) const;
  void add_piece(std::uint64_t address, std::uint64_t size);
  void follow(Hdf5Bytes continuation);

  const OpenFile& file_;
  std::uint64_t user_block_;
  std::uint64_t total_ = 0;  // bytes of all pieces
  std::vector<std::vector<std::uint8_t>> pieces_;
  std::vector<Hdf5Message> messages_;
};

}  // namespace limber
