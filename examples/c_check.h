/* For the C examples: CHECK prints the library's message and returns from main if a call fails. */
#ifndef EXAMPLES_C_CHECK_H
#define EXAMPLES_C_CHECK_H

#include <powercell.h>
#include <stdio.h>

#define CHECK(call)                                                               \
  do {                                                                            \
    pc_status check_status = (call);                                              \
    if (check_status != PC_OK) {                                                  \
      fprintf(stderr, "%s: %s\n", pc_status_name(check_status), pc_last_error()); \
      return 1;                                                                   \
    }                                                                             \
  } while (0)

#endif
