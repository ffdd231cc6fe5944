#include "host/cli/run_program.h"

int main(int argc, char** argv) { return edgescout::run_program(argc, argv); }
