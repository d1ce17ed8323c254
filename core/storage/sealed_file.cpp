#include "core/storage/sealed_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <span>
#include <string_view>
#include <vector>

#include "core/model/errors.h"
#include "core/storage/atomic_file.h"
#include "core/storage/state_hash.h"

namespace limber {
namespace {

namespace fs = std::filesystem;
using Block = std::array<char, kSealBytes>;

constexpr std::string_view kMagic = "limber ";
constexpr std::string_view kHdf5Magic = "\x89HDF\r\n\x1a\n";
constexpr std::size_t kChunk = 1 << 20;  // bytes read at a time

[[noreturn]] void refuse(const fs::path& file, std::string what, std::string remedy) {
  throw InputError({file.string(), std::move(what), std::move(remedy)});
}

// XXH3 of everything after the block; `size` receives the size of the whole file.
std::uint64_t checksum_of(int descriptor, const fs::path& file, std::uintmax_t& size) {
  std::vector<char> buffer(kChunk);
  StateHash hash;
  size = kSealBytes;
  while (const std::size_t n = read_at(descriptor, size, buffer.data(), buffer.size(), file)) {
    hash.add(std::span<const char>(buffer.data(), n));
    size += n;
  }
  return hash.value();
}

Block block_of(const Seal& seal) {
  Block block{};
  std::snprintf(block.data(), block.size(), "limber %s %d\nxxh3-64 %016llx\nbytes %llu\n",
                seal.kind.c_str(), seal.version, static_cast<unsigned long long>(seal.checksum),
                static_cast<unsigned long long>(seal.file_size));
  return block;
}

[[noreturn]] void refuse_foreign(const fs::path& file, std::string_view start) {
  const char* what = "is not a file of Limber's";
  if (start.empty()) what = "is empty";
  if (start.starts_with(kHdf5Magic)) what = "is an HDF5 file, but not one of Limber's";
  refuse(file, what, "name a file that Limber wrote, whole");
}

// Takes the text up to `end` off the front; everything if it does not occur.
std::string_view cut(std::string_view& text, char end) {
  const std::size_t at = std::min(text.find(end), text.size());
  const std::string_view front = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return front;
}

template <class Number>
bool parse(std::string_view text, Number& number, int base = 10) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc() && end == text.data() + text.size();
}

bool parse_field(std::string_view line, std::string_view name, std::uint64_t& value, int base) {
  return line.starts_with(name) && parse(line.substr(name.size()), value, base);
}

bool is_kind(std::string_view text) {
  return !text.empty() && text.size() <= 16 &&
         std::all_of(text.begin(), text.end(), [](char c) { return 'a' <= c && c <= 'z'; });
}

}  // namespace

Seal read_seal(const OpenFile& open) {
  const fs::path& file = open.path();
  Block block{};
  const std::size_t found = read_at(open.descriptor(), 0, block.data(), block.size(), file);
  std::string_view text(block.data(), found);
  Seal seal;
  if (!text.starts_with(kMagic)) refuse_foreign(file, text);
  text.remove_prefix(kMagic.size());
  seal.kind = cut(text, ' ');
  if (!is_kind(seal.kind) || !parse(cut(text, '\n'), seal.version) || seal.version < 1)
    refuse_foreign(file, "?");
  std::uint64_t size = 0;
  // What later versions write here is theirs; require_intact() compares it for this one.
  if (parse_field(cut(text, '\n'), "xxh3-64 ", seal.checksum, 16)) {
    parse_field(cut(text, '\n'), "bytes ", size, 10);
  }
  seal.file_size = size;
  return seal;
}

void require_intact(const OpenFile& open, const Seal& expected) {
  const fs::path& file = open.path();
  if (open.size() < expected.file_size)
    refuse(file,
           "is cut short: " + std::to_string(open.size()) + " of " +
               std::to_string(expected.file_size) + " bytes are there",
           "copy or write it again");
  Seal found{expected.kind, expected.version, 0, 0};
  found.checksum = checksum_of(open.descriptor(), file, found.file_size);
  Block block{};
  read_at(open.descriptor(), 0, block.data(), block.size(), file);
  if (block != block_of(found))
    refuse(file, "was changed or damaged after it was written: its checksum does not match",
           "copy or write it again; docs/model_file.md says how to seal a file of your own");
}

void seal(int descriptor, const std::string& kind, int version, const fs::path& target) {
  Seal seal{kind, version, 0, 0};
  seal.checksum = checksum_of(descriptor, target, seal.file_size);
  const Block block = block_of(seal);
  if (::pwrite(descriptor, block.data(), block.size(), 0) != ssize_t(block.size()))
    refuse_writing(target, errno);
}

}  // namespace limber
