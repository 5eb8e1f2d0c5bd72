# Build options and the flags every room shares.
option(ZEROTREE_BUILD_CONVERTER "Build the converter library and the zerotree command" ON)
option(ZEROTREE_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(ZEROTREE_BUILD_SAMPLES "Build the samples whose libraries are there" ${ZEROTREE_BUILD_TESTS})
option(ZEROTREE_INSTALL "Have install rules for the runtime and the command" ${PROJECT_IS_TOP_LEVEL})
option(ZEROTREE_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(ZEROTREE_FUZZ "Build the fuzzer, which takes clang; see tests/fuzz" OFF)
option(ZEROTREE_WERROR "Treat warnings as errors" ${PROJECT_IS_TOP_LEVEL})

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

add_library(zerotree_flags INTERFACE)
# No fused multiply-add: the same input must give the same bytes on every machine.
target_compile_options(zerotree_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off)
if(ZEROTREE_WERROR)
  target_compile_options(zerotree_flags INTERFACE -Werror)
endif()
if(ZEROTREE_SANITIZE)
  target_compile_options(zerotree_flags INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(zerotree_flags INTERFACE -fsanitize=address,undefined)
endif()
if(ZEROTREE_FUZZ)
  target_compile_options(zerotree_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
