#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/storage/array_values.h"
#include "core/storage/hdf5_sink.h"

namespace limber {

// Writes arrays of numbers, in groups one deep, to a new HDF5 file: contiguous, uncompressed,
// without times, so that the same arrays give the same bytes. One half of what model_layout.h walks
// with.
class ArrayFileWriter {
 public:
  // Writes to a descriptor that is open for reading and writing, behind a block of `user_block`
  // bytes. Messages name `target`.
  ArrayFileWriter(int descriptor, std::size_t user_block, std::filesystem::path target);

  void attribute(const char* name, const std::string& text);
  void attribute(const char* name, std::int32_t number);

  // visit(each) calls each(value) for all values of the array, in its order.
  template <class T, class Visit>
  void table(const ArraySpec<T>& spec, Visit visit) {
    std::size_t numbers = 0;
    bool left_out = spec.absent.has_value();
    const T usual = spec.absent.value_or(T{});
    visit([&](const auto& x) {
      left_out = left_out && same_bits(encoded<T>(x), usual);
      ++numbers;
    });
    if (left_out) return;
    Stream<T> stream(*this, spec, numbers);
    visit([&](const auto& x) { stream.push(encoded<T>(x)); });
    stream.flush();
  }

  // Where each list begins among the items of all, and at last how many there are.
  // visit(each) calls each(list) for all lists.
  template <class Visit>
  void lists(const char* path, const char*, Visit visit) {
    table(ArraySpec<std::int64_t>{path, "offset"}, [&](auto each) {
      std::int64_t start = 0;
      each(start);
      visit([&](const auto& list) { each(start += static_cast<std::int64_t>(list.size())); });
    });
  }

  // The reader's part: containers get the sizes that the file says.
  template <class... Containers>
  void count(const char*, const Containers&...) {}
  template <class... Containers>
  void count_lists(const char*, const Containers&...) {}

  // True where a group of arrays is to be written; the reader looks whether it is there.
  bool has(const char*, bool wanted) const { return wanted; }

  // Everything is in the file afterwards. Throws InputError where it is not.
  void close();

 private:
  template <class T>
  class Stream {
   public:
    Stream(ArrayFileWriter& file, const ArraySpec<T>& spec, std::size_t numbers)
        : file_(file),
          shape_(shape_of(numbers, spec.width)),
          dataset_(file.create(spec.path, spec.unit, number_type<T>(), shape_)),
          most_(kBufferNumbers / shape_.numbers_a_row() * shape_.numbers_a_row()) {
      buffer_.reserve(std::min(most_, numbers));
    }
    void push(T number) {
      buffer_.push_back(number);
      if (buffer_.size() == most_) flush();
    }
    void flush() {
      if (buffer_.empty()) return;
      const std::size_t rows = buffer_.size() / shape_.numbers_a_row();
      file_.write_rows(dataset_, number_type<T>(), shape_, written_, rows, buffer_.data());
      written_ += rows;
      buffer_.clear();
    }

   private:
    ArrayFileWriter& file_;
    ArrayShape shape_;
    Hdf5Handle dataset_;
    std::size_t most_;  // numbers in the buffer: whole rows
    std::vector<T> buffer_;
    std::size_t written_ = 0;  // rows
  };

  Hdf5Handle create(const std::string& path, const char* unit, NumberType type,
                    const ArrayShape& shape);
  void write_rows(hid_t dataset, NumberType type, const ArrayShape& shape, std::size_t first,
                  std::size_t count, const void* numbers);
  Hdf5Handle group_of(const std::string& path);
  void write_text(hid_t object, const char* name, const std::string& text);
  hid_t checked(hid_t id) const;
  [[noreturn]] void refuse() const;

  Hdf5Session session_;
  std::filesystem::path target_;
  Hdf5Sink sink_;
  Hdf5Handle file_;
};

}  // namespace limber
