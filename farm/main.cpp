#include "farm/commands.h"

int main(int argc, char** argv) {
  return veduta::veduta_main(argc, argv);
}
