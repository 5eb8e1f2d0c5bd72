// Prints extension-spec/VALIDATION.md: write_validation_document > extension-spec/VALIDATION.md
#include <cstdio>

#include "validation_document.h"

int main() {
  return std::fputs(zerotree::test::validation_document().c_str(), stdout) < 0 ? 1 : 0;
}
