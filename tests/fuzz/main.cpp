// Feeds scripts and API arguments of every wrong type and range to the program's scripting, see
// script_from_bytes.h. Built with -D LIMBER_FUZZ=ON it keeps what reaches new code and goes on from
// there; without, it does the same blindly. One seed, one order of runs.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "demos/scripting/api.h"
#include "tests/fuzz/coverage.h"
#include "tests/fuzz/feed_script.h"
#include "tests/fuzz/script_from_bytes.h"

namespace limber::demos::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Engine = std::mt19937_64;

constexpr std::size_t kMostBytes = 4000;

std::size_t below(Engine& random, std::size_t count) { return random() % count; }

// Every example of the reference, as it stands.
std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  const auto add = [&](const std::string& text) {
    Bytes bytes = {kAsItStands};
    bytes.insert(bytes.end(), text.begin(), text.end());
    all.push_back(std::move(bytes));
  };
  for (const ApiFunction& function : api_functions()) add(function.example);
  for (const ApiCallback& callback : api_callbacks()) add(callback.example);
  return all;
}

Bytes decisions(Engine& random) {
  Bytes bytes(20 + below(random, 400));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  bytes[0] = 1;
  return bytes;
}

// One to four changes: a byte, a piece less, a piece twice, a piece of another input.
Bytes changed(Bytes bytes, const Bytes& other, Engine& random) {
  for (std::size_t n = 1 + below(random, 4); n > 0; --n) {
    const std::size_t at = 1 + below(random, bytes.size());
    const std::size_t end = std::min(bytes.size(), at + 1 + below(random, 32));
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at, end));
    const auto to = bytes.begin() + static_cast<std::ptrdiff_t>(end);
    switch (below(random, 4)) {
      case 0:
        if (from != to) *from = static_cast<std::uint8_t>(random());
        break;
      case 1:
        if (bytes.size() > 2) bytes.erase(from, to);
        break;
      case 2: {
        const Bytes piece(from, to);
        bytes.insert(from, piece.begin(), piece.end());
        break;
      }
      default: {
        const std::size_t start = below(random, other.size());
        const std::size_t length = std::min(other.size() - start, 1 + below(random, 64));
        const auto first = other.begin() + static_cast<std::ptrdiff_t>(start);
        const Bytes piece(first, first + static_cast<std::ptrdiff_t>(length));
        bytes.insert(from, piece.begin(), piece.end());
      }
    }
  }
  bytes.resize(std::min(bytes.size(), kMostBytes));
  return bytes;
}

class Fuzzer {
 public:
  Fuzzer(std::uint64_t seed, std::string last) : random_(seed), last_(std::move(last)) {}

  // False: a fault, which was said.
  bool run(std::size_t runs, double seconds) {
    const auto start = std::chrono::steady_clock::now();
    const auto time_is_up = [&] {
      const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - start;
      return seconds > 0.0 && gone.count() > seconds;
    };
    for (const Bytes& seed : seeds()) {
      if (!feed(seed)) return false;
    }
    for (std::size_t n = 0; n < runs && !time_is_up(); ++n) {
      if (!feed(next())) return false;
      if (n % 1000 == 999) say(n + 1);
    }
    say(runs_);
    return true;
  }

 private:
  Bytes next() {
    if (below(random_, 3) == 0) return decisions(random_);
    const Bytes& other = corpus_[below(random_, corpus_.size())];
    return changed(corpus_[below(random_, corpus_.size())], other, random_);
  }

  bool feed(const Bytes& bytes) {
    const std::string script = script_from_bytes(bytes);
    if (!last_.empty()) std::ofstream(last_, std::ios::binary) << script;  // for after a crash
    forget_run();
    const std::string fault = fault_of(script);
    ++runs_;
    if (!fault.empty()) {
      std::fprintf(stderr, "%s\nin the script:\n%s\n", fault.c_str(), script.c_str());
      return false;
    }
    if (new_places() > 0 || corpus_.size() < 200) corpus_.push_back(bytes);
    return true;
  }

  void say(std::size_t n) const {
    std::printf("%zu runs, %zu inputs kept, %zu places\n", n, corpus_.size(), places());
    std::fflush(stdout);
  }

  Engine random_;
  std::string last_;
  std::vector<Bytes> corpus_;
  std::size_t runs_ = 0;
};

}  // namespace
}  // namespace limber::demos::fuzz

int main(int argc, char** argv) {
  CLI::App app("Feeds random scripts to Limber");
  std::size_t runs = 1'000'000'000;
  double seconds = 0.0;
  std::uint64_t seed = 1;
  std::string last;
  app.add_option("--runs", runs, "how many, beside the examples of the reference");
  app.add_option("--seconds", seconds, "for so long at most");
  app.add_option("--seed", seed, "of all that is random");
  app.add_option("--last", last, "file that every script is written to before it runs");
  CLI11_PARSE(app, argc, argv);
  return limber::demos::fuzz::Fuzzer(seed, last).run(runs, seconds) ? 0 : 1;
}
