#include "demos/cli/interrupt.h"

#include <csignal>

namespace limber::demos {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int) { interrupted = 1; }

}  // namespace

Interrupt::Interrupt() {
  interrupted = 0;
  old_interrupt_ = std::signal(SIGINT, remember);
  old_terminate_ = std::signal(SIGTERM, remember);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, old_interrupt_);
  std::signal(SIGTERM, old_terminate_);
}

bool Interrupt::came() const { return interrupted != 0; }

}  // namespace limber::demos
