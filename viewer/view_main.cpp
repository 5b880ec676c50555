#include "viewer/view_cli.h"

int main(int argc, char** argv) {
  return veduta::view_main(argc, argv);
}
