/* The public header is C: this file is compiled as C11 and used from the tests. */
#include "zerotree/zerotree.h"

zt_status zt_test_status_of_nothing(void) {
  zt_decoder* decoder = zt_create(NULL);
  const zt_status status = zt_feed(decoder, NULL, 0);
  zt_free(decoder);
  return status;
}
