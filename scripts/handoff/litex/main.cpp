// SPDX-License-Identifier: Apache-2.0
// Clock and reset of the SoC; what its UART sends goes to the standard output, up to the line "done".
#include <cstdio>
#include <cstdlib>
#include <string>

#include "Vsoc.h"

int main(int count, char **arguments) {
  Vsoc soc;
  const unsigned long limit = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 100000000;
  std::string line;
  soc.serial_source_ready = 1;
  for (unsigned long clock = 0; clock < limit; clock++) {
    soc.reset = clock < 4;
    soc.clock = 0;
    soc.eval();
    const bool sends = soc.serial_source_valid && !soc.reset;
    const char letter = soc.serial_source_data;
    soc.clock = 1;
    soc.eval();
    if (!sends) continue;
    std::putchar(letter);
    if (letter != '\n') {
      line += letter;
    } else if (line == "done") {
      std::printf("%lu\n", clock);
      return 0;
    } else {
      line.clear();
    }
  }
  std::puts("clocks ran out");
  return 1;
}
