#include "core/storage/state_hash.h"

#include <xxhash.h>

namespace limber {

struct StateHash::State {
  XXH3_state_t* xxh = XXH3_createState();
  ~State() { XXH3_freeState(xxh); }
};

StateHash::StateHash() : state_(std::make_unique<State>()) { XXH3_64bits_reset(state_->xxh); }
StateHash::~StateHash() = default;

void StateHash::add_bytes(const void* data, std::size_t size) {
  XXH3_64bits_update(state_->xxh, data, size);
}

std::uint64_t StateHash::value() const { return XXH3_64bits_digest(state_->xxh); }

}  // namespace limber
