#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/storage/open_file.h"

namespace limber {

// The first 512 bytes of every file of Limber's: text that says what the file is and seals what
// follows, so that damage is found before any library looks at the rest.
//
//   limber model 1
//   xxh3-64 0123456789abcdef        of all that follows the 512 bytes
//   bytes 123456                    of the whole file
//
// The rest of the 512 bytes is zero. HDF5 and what reads its files skip such a block.
inline constexpr std::size_t kSealBytes = 512;

struct Seal {
  std::string kind;              // "model"
  int version = 0;               // of that kind's format, from 1
  std::uint64_t checksum = 0;    // XXH3
  std::uintmax_t file_size = 0;  // bytes
};

// What a file says it is; says nothing about whether that is true. Throws InputError for what is
// not there, no regular file, or none of Limber's.
Seal read_seal(const OpenFile& file);

// Reads the whole file and throws InputError where it is not what was sealed.
void require_intact(const OpenFile& file, const Seal& seal);

// Writes the first 512 bytes over those of an open file, for what follows them now. Throws
// InputError that names `target`.
void seal(int descriptor, const std::string& kind, int version,
          const std::filesystem::path& target);

}  // namespace limber
