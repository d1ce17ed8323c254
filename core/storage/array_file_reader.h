#pragma once

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/storage/array_values.h"
#include "core/storage/hdf5_catalogue.h"
#include "core/storage/open_file.h"

namespace limber {

// Reads what ArrayFileWriter wrote, and takes nothing else: every array has to be where it is
// looked for, with the type and shape that are wanted. What a file claims never costs more memory
// than some times its size (hdf5_catalogue.h). Everything else is an InputError that names the file
// and the array.
class ArrayFileReader {
 public:
  // Behind a block of so many bytes. The file has to live as long as this.
  ArrayFileReader(const OpenFile& file, std::size_t user_block);

  std::string text_attribute(const char* name) const;
  std::int32_t number_attribute(const char* name) const;

  // visit(each) calls each(value) for all values of the array, in its order; all get their values.
  template <class T, class Visit>
  void table(const ArraySpec<T>& spec, Visit visit) {
    if (spec.absent && !has(spec.path, false)) return;  // everything has its default
    std::size_t numbers = 0;
    visit([&](const auto&) { ++numbers; });
    Stream<T> stream(*this, spec, numbers);
    visit([&](auto& x) {
      if (!decode(stream.next(), x)) stream.refuse_last();
    });
  }

  // Gives every list its size; the items themselves are the array at `items_path`.
  template <class Visit>
  void lists(const char* path, const char* items_path, Visit visit) {
    std::size_t count = 0;
    visit([&](const auto&) { ++count; });
    Stream<std::int64_t> starts(*this, {path, "offset"}, count + 1);
    const auto most = static_cast<std::int64_t>(numbers_at(items_path));
    std::int64_t start = starts.next();
    if (start != 0) starts.refuse_last();
    visit([&](auto& list) {
      const std::int64_t end = starts.next();
      if (end < start || end > most) starts.refuse_last();
      list.resize(static_cast<std::size_t>(end - start));
      start = end;
    });
    if (start != most) starts.refuse_last();
  }

  // As many elements as the array at `path` has rows.
  template <class... Containers>
  void count(const char* path, Containers&... containers) {
    const std::size_t n = rows_at(path);
    (give_size(containers, n), ...);
  }

  // As many as there are lists: one less than beginnings and ends.
  template <class... Containers>
  void count_lists(const char* path, Containers&... containers) {
    const std::size_t n = std::max<std::size_t>(rows_at(path), 1) - 1;
    (give_size(containers, n), ...);
  }

  bool has(const std::string& path, bool) const { return catalogue_.arrays.contains(path); }

  // Refuses what nobody asked for: a misspelt array must not count as one left out.
  void require_all_read() const;

  [[noreturn]] void refuse(const std::string& array, const std::string& what) const;

 private:
  template <class T>
  class Stream {
   public:
    Stream(ArrayFileReader& file, const ArraySpec<T>& spec, std::size_t numbers)
        : file_(file),
          path_(spec.path),
          left_(numbers),
          offset_(file.admit(spec.path, number_type<T>(), shape_of(numbers, spec.width))) {}
    T next() {
      if (at_ == buffer_.size()) refill();
      return buffer_[at_++];
    }
    [[noreturn]] void refuse_last() const {
      file_.refuse(path_, "has " + std::to_string(buffer_[at_ - 1]) + " at entry " +
                              std::to_string(refilled_ + at_ - 1));
    }

   private:
    // Never called at the end: the array has as many numbers as are asked for.
    void refill() {
      refilled_ += buffer_.size();
      buffer_.resize(std::min(kBufferNumbers, left_));
      at_ = 0;
      left_ -= buffer_.size();
      file_.read(path_, offset_, buffer_.data(), buffer_.size() * sizeof(T));
      offset_ += buffer_.size() * sizeof(T);
    }

    ArrayFileReader& file_;
    std::string path_;
    std::size_t left_;      // numbers not yet in the buffer
    std::uint64_t offset_;  // of the next of them in the file
    std::vector<T> buffer_;
    std::size_t at_ = 0;
    std::size_t refilled_ = 0;  // numbers before those in the buffer
  };

  const StoredArray& array_at(const std::string& path) const;
  std::size_t rows_at(const std::string& path) const;
  std::size_t numbers_at(const std::string& path) const;
  // Where in the file an array begins that has this type and shape.
  std::uint64_t admit(const std::string& path, NumberType type, const ArrayShape& shape);
  void read(const std::string& path, std::uint64_t offset, void* into, std::size_t bytes) const;

  const OpenFile& file_;
  Hdf5Catalogue catalogue_;
  std::set<std::string> read_;
};

}  // namespace limber
