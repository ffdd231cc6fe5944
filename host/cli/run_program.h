// edgescout VERB: runs the verb and turns every exception into one line and an exit code.
#pragma once

namespace edgescout {

// The program, once a process: takes the arguments of main and gives its exit code (exit_codes.h).
int run_program(int argc, char** argv);

}  // namespace edgescout
