#include <iostream>

#include "tests/reference/program.h"

int main(int argc, char** argv) {
  return limber::reference::program(argc, argv, std::cout, std::cerr);
}
