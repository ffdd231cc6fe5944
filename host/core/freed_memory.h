// For programs that process one image after the other.
#pragma once

namespace edgescout {

// Keeps what is freed for what is allocated next. Otherwise large lists come from the system and go
// back to it, and each of their pages costs a fault anew: 7 % of the time of an image on two
// threads. Of the whole process, so not for libraries. Does nothing where the C library has no such
// setting.
void keep_freed_memory();

}  // namespace edgescout
