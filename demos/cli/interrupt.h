#pragma once

namespace limber::demos {

// While one of these lives, Ctrl-C (SIGINT) and a polite request to end (SIGTERM) do not end the
// program: came() says that they came. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();  // both signals are again what they were
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool came() const;

 private:
  using Handler = void (*)(int);
  Handler old_interrupt_, old_terminate_;
};

}  // namespace limber::demos
