#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/storage/array_values.h"
#include "core/storage/hdf5_messages.h"
#include "core/storage/open_file.h"

namespace limber {

// An array as it lies in a file: contiguous, little endian.
struct StoredArray {
  NumberType type = NumberType::kUint8;
  std::vector<std::uint64_t> extents;  // at most two; none: one number
  std::uint64_t offset = 0;            // of its first byte in the file
  std::uint64_t bytes = 0;             // wholly in the file
};

// What an HDF5 file holds: arrays by path, groups one deep, and the attributes of the root.
struct Hdf5Catalogue {
  std::map<std::string, StoredArray> arrays;
  Hdf5Attributes attributes;
};

// Reads the structure of an HDF5 file (format specification 3.0: superblock version 2, object
// headers version 2) that is as plain as ArrayFileWriter makes them, and refuses all that is not:
// heaps, trees, chunks, filters, links and storage in other places, types of other kinds. Follows
// nothing it has not checked. libhdf5 is for files one trusts: with a hostile one version 1.10.8
// reads outside of its memory.
//
// Together the arrays claim no more bytes than the file has. Throws InputError.
Hdf5Catalogue read_catalogue(const OpenFile& file, std::uint64_t user_block);

}  // namespace limber
