#include <iostream>

#include "demos/cli/cli_main.h"

int main(int argc, char** argv) {
  return limber::demos::cli_main(argc, argv, std::cout, std::cerr);
}
