#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <utility>
#include <vector>

namespace limber {

// Index of one element of one kind. A PointId cannot be passed where an EdgeId is wanted.
// The default value names nothing: valid() is false.
template <class Tag>
struct Id {
  std::int32_t value = -1;

  constexpr Id() = default;
  constexpr explicit Id(std::size_t index) : value(static_cast<std::int32_t>(index)) {}
  constexpr bool valid() const { return value >= 0; }
  constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  constexpr auto operator<=>(const Id&) const = default;
};

using PointId = Id<struct PointTag>;
using EdgeId = Id<struct EdgeTag>;
using FaceId = Id<struct FaceTag>;
using CellId = Id<struct CellTag>;

// Half-open range [begin, end) of ids.
template <class IdType>
struct IdRange {
  std::int32_t begin = 0;
  std::int32_t end = 0;

  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
  bool contains(IdType id) const { return begin <= id.value && id.value < end; }
  IdRange shifted_by(std::size_t offset) const {
    const auto d = static_cast<std::int32_t>(offset);
    return {begin + d, end + d};
  }
  bool operator==(const IdRange&) const = default;
};

// A std::vector that only the matching id can index.
template <class IdType, class T>
class IdVector {
 public:
  IdVector() = default;
  explicit IdVector(std::size_t n, const T& value = T()) : items_(n, value) {}

  T& operator[](IdType id) { return items_[id.index()]; }
  const T& operator[](IdType id) const { return items_[id.index()]; }
  std::size_t size() const { return items_.size(); }
  bool empty() const { return items_.empty(); }
  bool contains(IdType id) const { return id.valid() && id.index() < items_.size(); }

  IdType push_back(T value) {
    items_.push_back(std::move(value));
    return IdType(items_.size() - 1);
  }
  void resize(std::size_t n, const T& value = T()) { items_.resize(n, value); }
  void reserve(std::size_t n) { items_.reserve(n); }
  void append(const IdVector& other) {
    items_.insert(items_.end(), other.items_.begin(), other.items_.end());
  }

  auto begin() { return items_.begin(); }
  auto end() { return items_.end(); }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }
  std::vector<T>& raw() { return items_; }
  const std::vector<T>& raw() const { return items_; }

 private:
  std::vector<T> items_;
};

// for (PointId p : ids_of(model.points)) ... Counts up to the size that `items` have now.
template <class IdType, class T>
auto ids_of(const IdVector<IdType, T>& items) {
  return std::views::iota(std::size_t{0}, items.size()) |
         std::views::transform([](std::size_t i) { return IdType(i); });
}

}  // namespace limber
