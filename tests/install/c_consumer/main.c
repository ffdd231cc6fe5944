#include <edgescout.h>
#include <stdio.h>

int main(void) {
  if (edgescout_require_abi(EDGESCOUT_ABI) != EDGESCOUT_OK) {
    fprintf(stderr, "%s\n", edgescout_last_error());
    return 1;
  }
  printf("edgescout %s by C\n", edgescout_version());
  return 0;
}
